#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The master goes and comes back: frames go on, and so do the services, over connections that are there."""
import os
import socket
import subprocess
import threading
import unittest

import rosgraph
import rospy
import rostest
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure

import support
import synthetic
from sks_detector.msg import DetectionArray
from sks_detector.srv import Info, LoadCodebook


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


class Master:
    def __init__(self, port):
        self._port = port
        self.start()

    def start(self):
        self._process = subprocess.Popen(["rosmaster", "--core", "-p", str(self._port)], stdout=subprocess.DEVNULL)
        support.wait_for(rosgraph.is_master_online, "the master")

    def kill(self):
        self._process.kill()
        self._process.wait()


def service(name, service_type):
    """Connected for good: no call asks a master where the node is. A call that does not return fails the test."""
    proxy = rospy.ServiceProxy("/detector/" + name, service_type, persistent=True)
    proxy.wait_for_service(support.PATIENCE)

    def call(*arguments):
        replies = []
        threading.Thread(target=lambda: replies.append(proxy(*arguments)), daemon=True).start()
        return support.wait_for(lambda: replies, "the reply of " + name)[0]
    return call


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
    port = free_port()
    os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % port
    master = Master(port)
    try:
        rospy.init_node("faults_master_test", disable_signals=True)
        rostest.rosrun("sks_detector", "faults_master", MasterTest)
    finally:
        master.kill()
