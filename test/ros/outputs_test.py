#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Detections in messages of other packages: ~detections_3d and ~boxes."""
import unittest

import numpy as np
import rospy
import rostest
from jsk_recognition_msgs.msg import BoundingBoxArray
from sks_detector.msg import DetectionArray
from sks_detector.srv import Info
from vision_msgs.msg import Detection3DArray

import support
import synthetic


class OutputsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.node = support.Node("detector", {"codebook": support.CODEBOOK}, executable="outputs_node")
        cls.node.__enter__()
        cls.source = support.CloudSource("/points")

    @classmethod
    def tearDownClass(cls):
        cls.node.__exit__()

    def listen(self, topic, message_type):
        recorder = support.Recorder("/detector/" + topic, message_type)
        self.addCleanup(recorder.close)
        support.wait_for(recorder.connections, "a connection to " + topic)
        return recorder

    def objects(self):
        rospy.wait_for_service("/detector/info", support.PATIENCE)
        return list(rospy.ServiceProxy("/detector/info", Info)().objects)

    def test_the_messages_are_those_of_noetic(self):
        self.assertEqual(Detection3DArray._md5sum, "05c51d9aea1fb4cfdc8effb94f197b6f")
        self.assertEqual(BoundingBoxArray._md5sum, "c8f4a8bb1acd18ce778d183912bb472d")

    def test_both_say_the_same_as_the_detections(self):
        found = self.listen("detections", DetectionArray)
        three_d = self.listen("detections_3d", Detection3DArray)
        boxes = self.listen("boxes", BoundingBoxArray)
        answer = support.answer(self.source, support.cloud_message(synthetic.scene()), found)
        stamp, detections = answer.header.stamp, answer.detections
        self.assertEqual(sorted(d.object for d in detections), ["round", "thing"])
        objects = self.objects()
        vision, jsk = three_d.wait_for_stamp(stamp), boxes.wait_for_stamp(stamp)
        self.assertEqual((vision.header.frame_id, jsk.header.frame_id), ("camera", "camera"))
        self.assertEqual((len(vision.detections), len(jsk.boxes)), (2, 2))
        for detection, in_vision, in_jsk in zip(detections, vision.detections, jsk.boxes):
            place = objects.index(detection.object)
            for header in (in_vision.header, in_jsk.header):
                self.assertEqual((header.stamp, header.frame_id), (stamp, "camera"))
            self.assertEqual([(r.id, r.pose) for r in in_vision.results], [(place, detection.pose)])
            self.assertAlmostEqual(in_vision.results[0].score, detection.score, places=6)
            self.assertEqual((in_vision.bbox.center, in_vision.bbox.size), (detection.box_center, detection.box_size))
            self.assertEqual((in_jsk.pose, in_jsk.dimensions), (detection.box_center, detection.box_size))
            self.assertEqual((in_jsk.label, in_jsk.value), (place, detection.score))
            np.testing.assert_allclose(support.position_of(in_jsk.pose), synthetic.position(detection.object), atol=0.01)

    def test_who_listens_to_one_of_them_alone_is_answered(self):
        for topic, message_type in (("detections_3d", Detection3DArray), ("boxes", BoundingBoxArray)):
            with self.subTest(topic):
                recorder = self.listen(topic, message_type)
                cloud = support.cloud_message(synthetic.scene(names=("thing",)))
                answer = support.answer(self.source, cloud, recorder)
                self.assertEqual(len(getattr(answer, "detections", None) or answer.boxes), 1)
                recorder.close()

    def test_a_scene_without_objects_is_an_empty_array(self):
        three_d = self.listen("detections_3d", Detection3DArray)
        boxes = self.listen("boxes", BoundingBoxArray)
        answer = support.answer(self.source, support.cloud_message(synthetic.scene(names=())), three_d)
        self.assertEqual(answer.detections, [])
        self.assertEqual(boxes.wait_for_stamp(answer.header.stamp).boxes, [])


if __name__ == "__main__":
    rospy.init_node("outputs_test")
    rostest.rosrun("sks_detector", "outputs", OutputsTest)
