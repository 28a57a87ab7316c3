#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The master goes and comes back."""
import os
import socket
import subprocess
import unittest

import rosgraph
import rospy
import rostest

import support
import synthetic
from sks_detector.msg import DetectionArray
from sks_detector.srv import Info


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


class MasterTest(unittest.TestCase):
    def test_frames_go_on_without_a_master_and_with_a_new_one(self):
        with support.Node(parameters={"codebook": support.CODEBOOK}) as node:
            info = rospy.ServiceProxy("/detector/info", Info, persistent=True)
            info.wait_for_service(support.PATIENCE)
            detections = support.Recorder("/detector/detections", DetectionArray)
            source = support.CloudSource("/points")
            source.wait_for_subscriber()

            def expect_answers():
                for _ in range(3):
                    stamp = source.send(support.cloud_message(synthetic.scene()))
                    self.assertEqual(len(detections.wait_for_stamp(stamp).detections), 2)
                self.assertTrue(info().codebook.startswith("synthetic ("))

            expect_answers()
            master.kill()
            expect_answers()
            master.start()
            expect_answers()
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
