# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the camera share: the synthetic view by formula, and waiting for messages and diagnostics."""
import threading
import time

import numpy as np
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

POINT = np.dtype([('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('rgb', '<u4')])


def synthetic_view(width, height):
    """Positions [m] and colours of driver/synthetic_view.hpp."""
    focal_length = 525.0 * width / 640.0
    u, v = np.meshgrid(np.arange(width), np.arange(height))
    slope_x = (u - 0.5 * (width - 1)) / focal_length
    slope_y = (v - 0.5 * (height - 1)) / focal_length
    box = (slope_x > -0.25) & (slope_x < -0.05) & (slope_y > -0.05) & (slope_y < 0.15)
    depth = np.where(box, 800, np.round(1200.0 / (1.0 + 0.5 * slope_y)))
    depth[:, :width // 64] = 0
    z = np.where(depth > 0, 0.001 * depth, np.nan)
    rgb = np.where(box, 0xc81e14, 0x28005a | ((255 * u // width) << 8))
    return slope_x * z, slope_y * z, z, rgb


def points_of(cloud):
    """The points of a cloud as an array of its height and width."""
    return np.frombuffer(cloud.data, POINT).reshape(cloud.height, cloud.width)


def wait_for(condition, what, timeout=30.0):
    """Waits for a condition, not for a time."""
    end = time.time() + timeout
    while time.time() < end:
        result = condition()
        if result:
            return result
        time.sleep(0.02)
    raise AssertionError('timeout: ' + what)


class Recorder:
    """All messages of a topic from now on."""

    def __init__(self, topic, message_type):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, message_type, self.messages.append, queue_size=100)

    def wait(self, count=1):
        """The first `count` messages that come from now on."""
        start = len(self.messages)
        wait_for(lambda: len(self.messages) >= start + count, self.subscriber.name)
        return self.messages[start:start + count]

    def close(self):
        self.subscriber.unregister()


class Diagnostics:
    """The last status of each node's camera."""

    def __init__(self):
        self.lock = threading.Lock()
        self.statuses = {}
        self.subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, self.receive)

    def receive(self, array):
        with self.lock:
            for status in array.status:
                self.statuses[status.name] = status

    def get(self, node):
        with self.lock:
            return self.statuses.get(node + ': camera')

    def wait(self, node, text, level=None):
        """Waits until the camera of a node says something."""
        def says():
            status = self.get(node)
            return status if status and text in status.message and level in (None, status.level) else None
        return wait_for(says, '%s says "%s"; it says %s' % (node, text, self.get(node)))


def values(status):
    return {entry.key: entry.value for entry in status.values}


ERROR = DiagnosticStatus.ERROR
OK = DiagnosticStatus.OK
