#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""dynamic_reconfigure: what it describes, changes and refuses."""
import os
import unittest

import dynamic_reconfigure.client
import rospy
import rostest
from dynamic_reconfigure.msg import Config, StrParameter
from dynamic_reconfigure.srv import Reconfigure

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


class ReconfigureTest(unittest.TestCase):
    def setUp(self):
        self.node = support.Node(parameters={"codebook": support.CODEBOOK})
        self.client = dynamic_reconfigure.client.Client("detector", timeout=support.PATIENCE)

    def tearDown(self):
        self.client.close()
        self.node.__exit__()

    def test_describes_every_setting(self):
        described = {p["name"]: p for p in self.client.get_parameter_descriptions(support.PATIENCE)}
        discard = described["keypoints.discard"]
        self.assertEqual((discard["type"], discard["min"], discard["max"], discard["default"]), ("double", 0, 0.99, 0.35))
        self.assertIn("[m]", described["keypoints.grid_size"]["description"])
        self.assertIn("fixed by the codebook", described["descriptor.radius"]["description"])
        detector = described["keypoints.detector"]
        self.assertEqual([c["value"] for c in eval(detector["edit_method"])["enum"]], ["grid", "iss"])
        self.assertIn("target_frame", described)
        self.assertNotIn("codebook", described)
        groups = [g["name"] for g in self.client.group_description["groups"].values()]
        self.assertIn("keypoints", groups)

    def test_changes_what_is_in_force(self):
        detections = support.Recorder("/detector/detections", DetectionArray)
        source = support.CloudSource("/points")
        found = support.answer(source, support.cloud_message(synthetic.scene()), detections)
        self.assertEqual(len(found.detections), 2)
        reply = self.client.update_configuration({"detection.threshold": 1.0, "silence_warning": 7.0})
        self.assertEqual((reply["detection.threshold"], reply["silence_warning"]), (1, 7))
        self.assertEqual(rospy.get_param("/detector/detection/threshold"), 1)
        self.assertEqual(rospy.get_param("/detector/silence_warning"), 7)
        found = support.answer(source, support.cloud_message(synthetic.scene()), detections)
        self.assertEqual(found.detections, [])
        detections.close()

    def test_more_threads_than_the_machine_has_use_for_are_not_started(self):
        detections = support.Recorder("/detector/detections", DetectionArray)
        source = support.CloudSource("/points")
        scene = support.cloud_message(synthetic.scene())
        expected = support.answer(source, scene, detections).detections
        before, most = self.node.threads(), max(16, os.cpu_count())
        reply = self.client.update_configuration({"threads": 256})
        self.assertEqual(reply["threads"], min(256, most))
        self.node.wait_for_output("threads = 256", "%d are used" % most)
        found = support.answer(source, scene, detections).detections
        self.assertLessEqual(self.node.threads(), before + most)
        self.assertEqual([d.score for d in found], [d.score for d in expected])
        self.client.update_configuration({"threads": 2})  # OpenMP keeps its threads where one is enough
        support.answer(source, scene, detections)
        support.wait_for(lambda: self.node.threads() <= before + 1, "the end of the threads")
        detections.close()

    def test_refuses_a_set_as_a_whole(self):
        status = support.Recorder("/detector/status", Status)
        before = self.client.get_configuration(support.PATIENCE)
        for wrong, reason in (({"detection.threshold": 0.7, "keypoints.discard": 5.0}, "keypoints.discard = 5"),
                              ({"detection.threshold": 0.7, "keypoints.detector": "sift"}, "one of grid, iss"),
                              ({"silence_warning": 1.0, "sanitize.min_range": 30.0}, "must be less than"),
                              ({"detection.threshold": 0.7, "descriptor.radius": 0.06},
                               "was trained with descriptor.radius = 0.05 (not 0.06)")):
            with self.subTest(reason):
                reply = self.client.update_configuration(wrong)
                for key in wrong:
                    self.assertEqual(reply[key], before[key])
                    self.assertEqual(rospy.get_param("/detector/" + key.replace(".", "/")), before[key])
                status.wait_for(lambda s: reason in s.last_error, reason)
        status.close()

    def test_refuses_unknown_names(self):
        status = support.Recorder("/detector/status", Status)
        call = rospy.ServiceProxy("/detector/set_parameters", Reconfigure)
        for name, reason in (("target_farme", "did you mean 'target_frame'?"), ("codebook", "only read when")):
            call(Config(strs=[StrParameter(name, "x")]))
            status.wait_for(lambda s: reason in s.last_error, reason)
        status.close()


if __name__ == "__main__":
    rospy.init_node("reconfigure_test")
    rostest.rosrun("sks_detector", "reconfigure", ReconfigureTest)
