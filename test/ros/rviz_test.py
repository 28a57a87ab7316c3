#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What rviz.launch shows of detector.launch, on a screen in memory drawn by software. SKS_SCREENSHOT=FILE.png keeps a
picture of it."""
import os
import signal
import subprocess
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import TransformStamped
from visualization_msgs.msg import MarkerArray

import screen
import support
import synthetic


@unittest.skipUnless(screen.AVAILABLE, "needs Xvfb and ImageMagick")
class RvizTest(unittest.TestCase):
    def setUp(self):
        self.screen = screen.Screen()
        self.rviz = None
        self.markers = support.Recorder("/detector/markers", MarkerArray)
        self.source = support.CloudSource("/points")

    def tearDown(self):
        self.markers.close()
        self.source.publisher.unregister()
        self.rviz.send_signal(signal.SIGINT)
        self.rviz.wait(support.PATIENCE)
        self.screen.close()

    def start(self, fixed_frame):
        self.rviz = subprocess.Popen(["roslaunch", "sks_detector", "rviz.launch", "points:=/points",
                                      "fixed_frame:=" + fixed_frame], env=self.screen.environment)
        support.wait_for(lambda: self.source.publisher.get_num_connections() >= 2, "rviz", 120)

    def pixels_like(self, color):
        """How many pixels of the screen have about this colour."""
        return int(self.screen.like(color).sum())

    def shown(self, points):
        self.source.send(support.cloud_message(points))
        return self.markers.messages[-1].markers if self.markers.messages else []

    def expect_boxes(self):
        """Their colours."""
        boxes = support.wait_for(lambda: [m for m in self.shown(synthetic.scene()) if m.ns == "boxes"], "boxes")
        colors = [(box.color.r, box.color.g, box.color.b) for box in boxes]
        self.assertEqual(len(set(colors)), 2)
        for color in colors:
            support.wait_for(lambda: self.shown(synthetic.scene()) and self.pixels_like(color) > 100,
                             "pixels %s" % (color,), 120)
        return colors

    def test_shows_boxes_and_clears_them(self):
        self.start("camera")
        colors = self.expect_boxes()
        if os.environ.get("SKS_SCREENSHOT"):
            self.screen.keep(os.environ["SKS_SCREENSHOT"])
        support.wait_for(lambda: self.shown(synthetic.scene(names=())) and max(map(self.pixels_like, colors)) < 50,
                         "the boxes to vanish", 120)

    def test_looks_at_the_boxes_in_a_frame_whose_z_points_up(self):
        camera = TransformStamped()  # 0.6 m above the floor, looking ahead
        camera.header.frame_id, camera.child_frame_id = "base_link", "camera"
        camera.transform.translation.z = 0.6
        turn = camera.transform.rotation
        turn.x, turn.y, turn.z, turn.w = -0.5, 0.5, -0.5, 0.5
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(camera)
        self.start("base_link")
        self.expect_boxes()


if __name__ == "__main__":
    rospy.init_node("rviz_test")
    rostest.rosrun("sks_detector", "rviz", RvizTest)
