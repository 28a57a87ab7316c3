#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""robot.launch with the synthetic camera: its clouds are answered, also after the manager of both nodelets has died."""
import os
import signal
import sys
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from nodelet.srv import NodeletList
from sensor_msgs.msg import CameraInfo

from sks_detector.msg import DetectionArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from camera_testing import Recorder, wait_for  # noqa: E402


class RobotTest(unittest.TestCase):
    def setUp(self):
        self.frames = Recorder('/camera/camera_info', CameraInfo)  # as many as clouds, and small
        self.detections = Recorder('/detector/detections', DetectionArray)

    def tearDown(self):
        self.frames.close()
        self.detections.close()

    def expect_answer(self, since):
        """To a frame of the camera, with its stamp and frame."""
        def answer():
            stamps = {frame.header.stamp for frame in list(self.frames.messages)}
            return next((m for m in list(self.detections.messages)
                         if m.header.stamp > since and m.header.stamp in stamps), None)
        found = wait_for(answer, 'an answer', 100)
        self.assertEqual(found.header.frame_id, 'camera_rgb_optical_frame')
        self.assertTrue(found.codebook.startswith('synthetic ('), found.codebook)

    def test_camera_and_detector_share_a_manager(self):
        self.expect_answer(rospy.Time())
        self.assertEqual(set(rospy.ServiceProxy('/sks_manager/list', NodeletList)().nodelets), {'/camera', '/detector'})

    def test_comes_back_when_the_manager_dies(self):
        self.expect_answer(rospy.Time())
        manager = rosgraph.Master('/robot_test').lookupNode('/sks_manager')
        os.kill(xmlrpc.client.ServerProxy(manager).getPid('/robot_test')[2], signal.SIGKILL)
        self.expect_answer(rospy.Time.now() + rospy.Duration(1))


if __name__ == '__main__':
    rospy.init_node('robot_test')
    rostest.rosrun('sks_detector', 'robot_test', RobotTest)
