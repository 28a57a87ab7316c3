#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What rviz.launch shows of detector.launch, on a screen in memory drawn by software."""
import os
import shutil
import signal
import subprocess
import unittest

import numpy as np
import rospy
import rostest
from visualization_msgs.msg import MarkerArray

import support
import synthetic

WIDTH, HEIGHT = 1280, 800


@unittest.skipUnless(shutil.which("Xvfb") and shutil.which("import"), "needs Xvfb and ImageMagick")
class RvizTest(unittest.TestCase):
    def setUp(self):
        self.screen = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-screen", "0", "%dx%dx24" % (WIDTH, HEIGHT), "-nolisten", "tcp"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        display = ":" + self.screen.stdout.readline().decode().strip()
        self.environment = dict(os.environ, DISPLAY=display, LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
        self.rviz = subprocess.Popen(["roslaunch", "sks_detector", "rviz.launch", "points:=/points",
                                      "fixed_frame:=camera"], env=self.environment)

    def tearDown(self):
        for process in (self.rviz, self.screen):
            process.send_signal(signal.SIGINT)
            process.wait(support.PATIENCE)

    def pixels_like(self, color, tolerance=12):
        """How many pixels of the screen have about this colour."""
        shot = subprocess.check_output(["import", "-silent", "-window", "root", "-depth", "8", "rgb:-"],
                                       env=self.environment)
        pixels = np.frombuffer(shot, np.uint8).reshape(-1, 3).astype(int)
        return int((np.abs(pixels - np.round(255 * np.array(color))).max(1) <= tolerance).sum())

    def test_shows_boxes_and_keypoints_and_clears_them(self):
        markers = support.Recorder("/detector/markers", MarkerArray)
        source = support.CloudSource("/points")
        support.wait_for(lambda: source.publisher.get_num_connections() >= 2, "rviz", 120)

        def shown(points):
            source.send(support.cloud_message(points))
            return markers.messages[-1].markers if markers.messages else []

        boxes = support.wait_for(lambda: [m for m in shown(synthetic.scene()) if m.ns == "boxes"], "boxes")
        colors = [(box.color.r, box.color.g, box.color.b) for box in boxes]
        self.assertEqual(len(set(colors)), 2)
        for color in colors + [(0, 160 / 255, 1)]:  # the last is that of the keypoints
            support.wait_for(lambda: shown(synthetic.scene()) and self.pixels_like(color) > 100, "pixels %s" % (color,),
                             120)
        support.wait_for(lambda: shown(synthetic.scene(names=())) and max(map(self.pixels_like, colors)) < 50,
                         "the boxes to vanish", 120)
        markers.close()


if __name__ == "__main__":
    rospy.init_node("rviz_test")
    rostest.rosrun("sks_detector", "rviz", RvizTest)
