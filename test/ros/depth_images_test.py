#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""depth_images.launch on the images of a synthetic scene: what it finds, and that it comes back when its manager dies."""
import os
import signal
import unittest
import xmlrpc.client

import numpy as np
import rosgraph
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image

import support
import synthetic
from sks_detector.msg import DetectionArray

BONDS_FORM = 3.0  # by which nodelet's loaders tell that their manager has died: heartbeats of one second [s]
PIXEL = 0.0025  # of synthetic.view() at the distance of 1 m [m]


class Camera:
    """Publishes depth, colour and calibration of a scene until it is closed."""

    def __init__(self, points):
        height, width = points.shape[:2]
        self._depth = Image(height=height, width=width, encoding="32FC1", step=4 * width,
                            data=points[..., 2].astype(np.float32).tobytes())
        self._color = Image(height=height, width=width, encoding="rgb8", step=3 * width, data=bytes(3 * width * height))
        fx, cx, cy = 1 / PIXEL, width / 2, height / 2
        self._info = CameraInfo(height=height, width=width, distortion_model="plumb_bob", D=[0] * 5,
                                K=[fx, 0, cx, 0, fx, cy, 0, 0, 1], R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
                                P=[fx, 0, cx, 0, 0, fx, cy, 0, 0, 0, 1, 0])
        self._publishers = [rospy.Publisher(topic, kind, queue_size=2) for topic, kind in (
            ("/camera/depth_registered/image_rect", Image), ("/camera/rgb/image_rect_color", Image),
            ("/camera/rgb/camera_info", CameraInfo))]
        self._timer = rospy.Timer(rospy.Duration(0.2), self._publish)

    def _publish(self, _):
        stamp = rospy.Time.now()
        for publisher, message in zip(self._publishers, (self._depth, self._color, self._info)):
            message.header.stamp, message.header.frame_id = stamp, "camera"
            publisher.publish(message)

    def close(self):
        self._timer.shutdown()


class DepthImagesTest(unittest.TestCase):
    def setUp(self):
        self.camera = Camera(synthetic.scene())
        self.detections = support.Recorder("/detector/detections", DetectionArray)

    def tearDown(self):
        self.detections.close()
        self.camera.close()

    def expect_answer(self, since):
        answer = self.detections.wait_for(lambda m: m.header.stamp > since, "an answer")
        self.assertEqual(answer.header.frame_id, "camera")
        self.assertEqual(sorted(d.object for d in answer.detections), ["round", "thing"])
        for detection in answer.detections:
            np.testing.assert_allclose(support.position_of(detection.box_center), synthetic.position(detection.object),
                                       atol=0.01)

    def test_finds_objects_in_depth_images(self):
        self.expect_answer(rospy.Time())

    def test_comes_back_when_its_manager_dies(self):
        self.expect_answer(rospy.Time())
        rospy.sleep(BONDS_FORM)
        manager = rosgraph.Master("/depth_images_test").lookupNode("/detector_manager")
        os.kill(xmlrpc.client.ServerProxy(manager).getPid("/depth_images_test")[2], signal.SIGKILL)
        died = rospy.Time.now()
        self.expect_answer(died + rospy.Duration(1))


if __name__ == "__main__":
    rospy.init_node("depth_images_test")
    rostest.rosrun("sks_detector", "depth_images", DepthImagesTest)
