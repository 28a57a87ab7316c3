#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Private parameters and dynamic_reconfigure."""
import glob
import os
import unittest

import rospkg
import rospy
import rostest
import yaml

import support
from sks_detector.msg import Status


class ParametersTest(unittest.TestCase):
    def test_warns_about_unknown_parameters_with_the_nearest_name(self):
        wrong = {"keypoints/discrad": 0.1, "descriptor/grid_size": 0.03, "target_farme": "map", "other/thing": 1}
        with support.Node(parameters=wrong) as node:
            for name, nearest in (("keypoints/discrad", "keypoints/discard"),
                                  ("descriptor/grid_size", "keypoints/grid_size"), ("target_farme", "target_frame")):
                node.wait_for_output("unknown parameter /detector/" + name, "did you mean /detector/%s?" % nearest)
            node.wait_for_output("unknown parameter /detector/other/thing")
            self.assertTrue(node.alive())

    def test_refuses_an_invalid_set_and_runs_with_the_defaults(self):
        for wrong, reasons in (
                ({"keypoints/discard": 2.0, "keypoints/grid_size": 0.03}, ("keypoints/discard", "0 to 0.99")),
                ({"keypoints/discard": "much"}, ("keypoints/discard", "a number in 0 to 0.99")),
                ({"keypoints/discard": [1]}, ("keypoints/discard", "a list")),
                ({"sanitize/min_range": 3.0, "sanitize/max_range": 2.0}, ("min_range = 3 must be less than",)),
                ({"tf_timeout": -1.0}, ("tf_timeout", "0 to 60 [s]")),
                ({"always_on": "perhaps"}, ("always_on", "true or false"))):
            with self.subTest(str(wrong)), support.Node(parameters=wrong):
                status = support.Recorder("/detector/status", Status)
                for reason in reasons:
                    status.wait_for(lambda s: reason in s.last_error, reason)
                support.wait_for(lambda: rospy.has_param("/detector/threads"), "the parameters in force")
                self.assertEqual(rospy.get_param("/detector/keypoints/discard"), 0.35)
                self.assertEqual(rospy.get_param("/detector/keypoints/grid_size"), 0.02)
                self.assertEqual(rospy.get_param("/detector/sanitize/max_range"), 20)
                self.assertEqual(rospy.get_param("/detector/tf_timeout"), 0.2)
                status.close()

    def test_reports_a_codebook_that_cannot_be_read(self):
        with support.Node(parameters={"codebook": "/nowhere/missing.sks"}):
            status = support.Recorder("/detector/status", Status)
            error = status.wait_for(lambda s: "/nowhere/missing.sks" in s.last_error)
            self.assertEqual(error.state, Status.NO_CODEBOOK)
            status.close()

    def test_takes_a_tilde_for_the_home_folder(self):
        home = os.path.dirname(support.CODEBOOK)
        environment = dict(os.environ, HOME=home, ROS_LOG_DIR=os.path.join(home, "log"))
        status = support.Recorder("/detector/status", Status)
        with support.Node(parameters={"codebook": "~/synthetic.sks"}, environment=environment):
            status.wait_for(lambda s: s.codebook_file == support.CODEBOOK, "the codebook")
        status.close()

    def test_loads_every_shipped_settings_file(self):
        files = glob.glob(os.path.join(rospkg.RosPack().get_path("sks_detector"), "config", "*.yaml"))
        self.assertGreaterEqual(len(files), 3)
        for path in files:
            with open(path) as file:
                settings = yaml.safe_load(file)
            with self.subTest(path), support.Node(parameters=settings) as node:
                support.wait_for(lambda: rospy.has_param("/detector/threads"), "the parameters in force")
                for group, values in settings.items():
                    in_force = rospy.get_param("/detector/" + group)
                    for key, value in values.items():
                        self.assertEqual(in_force[key], value)
                self.assertNotIn("unknown parameter", node.output())
                self.assertNotIn("ERROR", node.output())

    def test_leaves_a_core_to_others(self):
        with support.Node():
            support.wait_for(lambda: rospy.has_param("/detector/threads"), "the parameters in force")
            self.assertEqual(rospy.get_param("/detector/threads"), max(1, os.cpu_count() - 1))


if __name__ == "__main__":
    rospy.init_node("parameters_test")
    rostest.rosrun("sks_detector", "parameters", ParametersTest)
