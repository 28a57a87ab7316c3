#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs test/rviz/display_test.cpp, in which rviz is part of the test, on a screen in memory."""
import subprocess
import unittest

import rospy
import rostest

import screen


@unittest.skipUnless(screen.AVAILABLE, "needs Xvfb and ImageMagick")
class RvizPartsTest(unittest.TestCase):
    def test_status_selection_and_properties_of_the_display(self):
        on_screen = screen.Screen()
        self.addCleanup(on_screen.close)
        run = subprocess.run(["rosrun", "sks_detector", "sks_rviz_tests", "--gtest_filter=DetectionsDisplayTest.*"],
                             env=on_screen.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             universal_newlines=True, timeout=240)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn("[  PASSED  ] 9 tests", run.stdout)


if __name__ == "__main__":
    rospy.init_node("rviz_parts_test")
    rostest.rosrun("sks_detector", "rviz_parts", RvizPartsTest)
