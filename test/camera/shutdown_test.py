#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Starts the camera with wrong parameters, as nodelet and as executable, and interrupts it while frames flow."""
import os
import signal
import subprocess
import sys
import unittest

import rospy
import rostest
from sensor_msgs.msg import PointCloud2

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from camera_testing import Recorder  # noqa: E402


class ShutdownTest(unittest.TestCase):
    def check(self, command, how=signal.SIGINT):
        parameters = ['_device:=sks-test://0', '_widht:=320', '_rate:=-5', '_loop:=maybe', '_height:=240']
        process = subprocess.Popen(command + ['__name:=tested'] + parameters, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, universal_newlines=True)
        try:
            recorder = Recorder('/tested/points', PointCloud2)
            self.assertEqual(recorder.wait(5)[0].height, 480)
            process.send_signal(how)
            output = process.communicate(timeout=30)[0]
            recorder.close()
        finally:
            process.kill()
        self.assertEqual(process.returncode, 0, output)
        self.assertIn('unknown parameter /tested/widht is ignored: did you mean /tested/width?', output)
        self.assertIn('parameter /tested/rate: rate = -5 is out of range: 1 to 1000 [Hz]; the default is used', output)
        self.assertIn('parameter /tested/loop: loop = maybe: expected true or false; the default is used', output)
        self.assertIn('it has no mode of 640x240 at 30 Hz: the nearest, 640x480 at 30 Hz, is used', output)
        for trouble in ('terminate', 'abort', 'boost::', 'class_loader'):
            self.assertNotIn(trouble, output)

    def test_executable(self):
        self.check(['rosrun', 'sks_detector', 'camera_node'])

    def test_executable_that_is_terminated(self):
        self.check(['rosrun', 'sks_detector', 'camera_node'], signal.SIGTERM)

    def test_nodelet(self):
        self.check(['rosrun', 'nodelet', 'nodelet', 'standalone', 'sks_detector/CameraNodelet'])


if __name__ == '__main__':
    rospy.init_node('shutdown_test')
    rostest.rosrun('sks_detector', 'shutdown_test', ShutdownTest)
