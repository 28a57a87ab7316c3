#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The master goes and comes back: frames go on, and so do the services, over connections that are there."""
import unittest

import rospy
import rostest
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure

import support
import synthetic
from own_master import Master, service
from sks_detector.msg import DetectionArray
from sks_detector.srv import Info, LoadCodebook


class MasterTest(unittest.TestCase):
    def test_frames_and_services_go_on_without_a_master_and_with_a_new_one(self):
        parameters = {"codebook": support.CODEBOOK, "codebook_directory": support.DATA}
        with support.Node(parameters=parameters) as node:
            info, load = service("info", Info), service("load_codebook", LoadCodebook)
            reconfigure = service("set_parameters", Reconfigure)
            detections = support.Recorder("/detector/detections", DetectionArray)
            source = support.CloudSource("/points")
            source.wait_for_subscriber()

            def set_threshold(value):
                config = Config(doubles=[DoubleParameter("detection.threshold", value)])
                in_force = reconfigure(config).config
                self.assertEqual({d.name: d.value for d in in_force.doubles}["detection.threshold"], value)

            def expect_answers(count):
                for _ in range(3):
                    stamp = source.send(support.cloud_message(synthetic.scene()))
                    self.assertEqual(len(detections.wait_for_stamp(stamp).detections), count)

            def expect_all_to_go_on():
                set_threshold(1.0)
                expect_answers(0)
                set_threshold(0.5)
                expect_answers(2)
                self.assertEqual(load("synthetic.sks").codebook, info().codebook)
                self.assertTrue(info().codebook.startswith("synthetic ("))
                self.assertIn("missing.sks", load("missing.sks").message)

            expect_all_to_go_on()
            for _ in range(2):
                master.kill()
                expect_all_to_go_on()
                master.start()
                expect_all_to_go_on()
            self.assertTrue(node.alive())


if __name__ == "__main__":
    master = Master()
    try:
        rospy.init_node("faults_master_test", disable_signals=True)
        rostest.rosrun("sks_detector", "faults_master", MasterTest)
    finally:
        master.kill()
