#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the nodelet publishes of good, empty and malformed clouds."""
import unittest

import numpy as np
import rospy
import rostest
from sensor_msgs.msg import PointCloud2
from visualization_msgs.msg import Marker, MarkerArray

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


class DetectionTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.detections = support.Recorder("/detector/detections", DetectionArray)
        cls.source = support.CloudSource("/points")

    def answer(self, message):
        return self.detections.wait_for_stamp(self.source.send(message))

    def expect_both(self, answer):
        self.assertEqual(sorted(d.object for d in answer.detections), ["round", "thing"])
        for detection in answer.detections:
            name = detection.object
            np.testing.assert_allclose(support.position_of(detection.box_center), synthetic.position(name), atol=0.01)
            difference = np.linalg.inv(synthetic.model_pose(name)) @ support.matrix_of(detection.pose.pose)
            self.assertLess(np.degrees(np.arccos(min(1, (np.trace(difference[:3, :3]) - 1) / 2))), 5)
            self.assertGreaterEqual(detection.score, 0.5)
            self.assertLessEqual(detection.score, 1)

    def test_finds_both_objects(self):
        answer = self.answer(support.cloud_message(synthetic.scene()))
        self.expect_both(answer)
        self.assertEqual(answer.header.frame_id, "camera")
        self.assertTrue(answer.codebook.startswith("synthetic ("), answer.codebook)
        self.assertGreater(answer.processing_time, 0)

    def test_takes_unorganized_dense_coloured_clouds_and_strips_the_slash(self):
        points = synthetic.scene().reshape(-1, 3)
        points = points[np.isfinite(points).all(1)]
        for field in ("rgb", "rgba"):
            message = support.cloud_message(points, "/camera", None, np.full(points.shape, 99), field)
            answer = self.answer(message)
            self.expect_both(answer)
            self.assertEqual(answer.header.frame_id, "camera")


if __name__ == "__main__":
    rospy.init_node("detection_test")
    rostest.rosrun("sks_detector", "detection", DetectionTest)
