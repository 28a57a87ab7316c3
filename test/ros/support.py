# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the node have in common."""
import os
import signal
import subprocess
import threading
import time

import numpy as np
import rospy
from sensor_msgs.msg import PointCloud2, PointField

# Where make_data.py has put its files.
DATA = os.environ["SKS_TEST_DATA"]
CODEBOOK = os.path.join(DATA, "synthetic.sks")

# Far longer than anything takes on an idle machine: tests wait for conditions, not for times.
PATIENCE = float(os.environ.get("SKS_TEST_PATIENCE", 60))


def wait_for(condition, what, timeout=PATIENCE):
    """The first true value of `condition()`; fails naming `what` was waited for."""
    end = time.monotonic() + timeout
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)
    raise AssertionError("waited %.0f s for %s" % (timeout, what))


class Recorder:
    """Keeps all messages of a topic."""

    def __init__(self, topic, message_type):
        self.topic = topic
        self._messages = []
        self._changed = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, message_type, self._receive)

    def _receive(self, message):
        with self._changed:
            self._messages.append(message)
            self._changed.notify_all()

    @property
    def messages(self):
        with self._changed:
            return list(self._messages)

    def clear(self):
        with self._changed:
            self._messages = []

    def wait_for(self, condition=lambda message: True, what="a message", timeout=PATIENCE):
        """The first message that fulfils the condition, as soon as it comes."""
        with self._changed:
            found = self._changed.wait_for(lambda: next((m for m in self._messages if condition(m)), None), timeout)
        if found is None:
            raise AssertionError("waited %.0f s for %s on %s" % (timeout, what, self.topic))
        return found

    def wait_for_stamp(self, stamp, timeout=PATIENCE):
        return self.wait_for(lambda m: m.header.stamp == stamp, "an answer to the cloud of %s" % stamp, timeout)

    def connections(self):
        return self._subscriber.get_num_connections()

    def close(self):
        self._subscriber.unregister()


def cloud_message(points, frame="camera", stamp=None, colors=None, color_field="rgb"):
    """A PointCloud2 of N x 3 or, organised, height x width x 3 points [m]; `colors` of the same shape, 0 to 255."""
    points = np.asarray(points, np.float32)
    if points.ndim == 2:
        points = points[None]
    message = PointCloud2()
    message.header.frame_id = frame
    message.header.stamp = stamp if stamp is not None else rospy.Time.now()
    message.height, message.width = points.shape[:2]
    names = ["x", "y", "z"]
    columns = points.reshape(-1, 3)
    if colors is not None:
        r, g, b = np.asarray(colors, np.uint32).reshape(-1, 3).T
        packed = ((r << 16) | (g << 8) | b).astype(np.uint32)
        columns = np.column_stack([columns, packed.view(np.float32)])
        names.append(color_field)
    message.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate(names)]
    if color_field == "rgba" and colors is not None:
        message.fields[-1].datatype = PointField.UINT32
    message.point_step = 4 * len(names)
    message.row_step = message.point_step * message.width
    message.is_dense = bool(np.isfinite(points).all())
    message.data = np.ascontiguousarray(columns, np.float32).tobytes()
    return message


def points_of(message):
    """The positions of a cloud whose fields start with x, y, z: N x 3 [m]."""
    rows = np.frombuffer(message.data, np.uint8).reshape(-1, message.point_step)[:, :12]
    return np.ascontiguousarray(rows).view(np.float32)


class CloudSource:
    """Publishes clouds, once the node has subscribed."""

    def __init__(self, topic, queue_size=10):
        self.topic = topic
        self.publisher = rospy.Publisher(topic, PointCloud2, queue_size=queue_size)

    def wait_for_subscriber(self):
        wait_for(lambda: self.publisher.get_num_connections() > 0, "a subscriber of " + self.topic)

    def send(self, message):
        """Its stamp."""
        self.wait_for_subscriber()
        self.publisher.publish(message)
        return message.header.stamp


def answer(source, message, recorder):
    """The answer to a cloud. It is sent again until it comes, stamped anew: who listens may have gone, not be there yet, or
    not know the time yet."""
    stamps = []

    def received():
        message.header.stamp = rospy.Time.now()
        stamps.append(source.send(message))
        try:
            return recorder.wait_for(lambda m: m.header.stamp in stamps, timeout=2)
        except AssertionError:
            return None
    return wait_for(received, "an answer on " + recorder.topic)


def position_of(pose):
    return np.array([pose.position.x, pose.position.y, pose.position.z])


def matrix_of(pose):
    return _matrix(pose.position, pose.orientation)


def matrix_of_transform(transform):
    return _matrix(transform.translation, transform.rotation)


def _matrix(position, orientation):
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    T = np.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = [position.x, position.y, position.z]
    return T


def log_messages(recorder, text):
    """Messages of /rosout_agg that contain a text."""
    return [m.msg for m in recorder.messages if text in m.msg]


def status_of(process, key):
    with open("/proc/%d/status" % process) as status:
        return next(int(line.split()[1]) for line in status if line.startswith(key + ":"))


def memory_of(process):
    """Resident [MB]."""
    return status_of(process, "VmRSS") / 1024


def threads_of(process):
    return status_of(process, "Threads")


class Node:
    """detector_node, or another executable, in a process of its own, with its output; ends it when the `with` block is
    left."""

    def __init__(self, name="detector", parameters=None, arguments=(), environment=None, executable="detector_node"):
        self.name = name
        for key, value in (parameters or {}).items():
            rospy.set_param("/%s/%s" % (name, key), value)
        self._lines = []
        self._process = subprocess.Popen(
            ["rosrun", "sks_detector", executable, "__name:=" + name, "~points:=/points", *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, env=environment)
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self._process.stdout:
            self._lines.append(line)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        status = self.stop()
        if rospy.has_param("/" + self.name):
            rospy.delete_param("/" + self.name)
        assert status == 0, "exit status %s of %s:\n%s" % (status, self.name, self.output())

    def alive(self):
        return self._process.poll() is None

    def memory(self):
        """Resident [MB]."""
        return memory_of(self._process.pid)

    def threads(self):
        return threads_of(self._process.pid)

    def send_signal(self, which):
        self._process.send_signal(which)

    def output(self):
        return "".join(self._lines)

    def wait_for_output(self, *texts):
        """Waits until one line of the output holds all the texts."""
        return wait_for(lambda: next((line for line in list(self._lines) if all(t in line for t in texts)), None),
                        "%s in the output of %s" % (texts, self.name))

    def stop(self, how=signal.SIGINT):
        """Ends it, unless told otherwise as Ctrl-C does; the exit status."""
        if self.alive():
            self._process.send_signal(how)
        status = self._process.wait(PATIENCE)
        self._reader.join()
        return status
