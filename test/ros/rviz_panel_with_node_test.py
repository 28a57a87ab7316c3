#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs test/rviz/panel_with_node_test.cpp, in which the panel's buttons are pressed, beside a detector whose camera sees one
thing on a table."""
import os
import subprocess
import threading

import rospy
import rostest

import services_support
import support
import synthetic
from services_support import standing, tabletop


class RvizPanelWithNodeTest(services_support.ServicesTest):
    def test_buttons(self):
        points = tabletop(standing(synthetic.THING, 0.05))
        done = threading.Event()

        def stream():
            while not done.wait(0.5):
                self.source.publisher.publish(support.cloud_message(points))
        camera = threading.Thread(target=stream)
        camera.start()
        try:
            run = subprocess.run(["rosrun", "sks_detector", "sks_rviz_tests", "--gtest_filter=PanelWithNodeTest.*"],
                                 env=dict(os.environ, QT_QPA_PLATFORM="offscreen"), stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, universal_newlines=True, timeout=240)
        finally:
            done.set()
            camera.join()
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn("[  PASSED  ] 1 test", run.stdout)


if __name__ == "__main__":
    rospy.init_node("rviz_panel_with_node_test")
    rostest.rosrun("sks_detector", "rviz_panel_with_node", RvizPanelWithNodeTest)
