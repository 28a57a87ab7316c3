#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs test/rviz/panel_with_node_test.cpp, in which the panel's buttons are pressed, beside a detector whose camera sees one
thing on a table."""
import os
import shutil
import subprocess
import threading

import rospy
import rostest

import services_support
import support
import synthetic
from services_support import standing, tabletop
from sks_detector.msg import Status


class RvizPanelWithNodeTest(services_support.ServicesTest):
    def press_buttons_of(self, test):
        run = subprocess.run(["rosrun", "sks_detector", "sks_rviz_tests", "--gtest_filter=PanelWithNodeTest." + test],
                             env=dict(os.environ, QT_QPA_PLATFORM="offscreen"), stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, universal_newlines=True, timeout=240)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn("[  PASSED  ] 1 test", run.stdout)

    def test_each_button_with_a_camera(self):
        points = tabletop(standing(synthetic.THING, 0.05))
        done = threading.Event()

        def stream():
            while not done.wait(0.5):
                self.source.publisher.publish(support.cloud_message(points))
        camera = threading.Thread(target=stream)
        camera.start()
        try:
            self.press_buttons_of("EachButtonDoesWhatItSays")
        finally:
            done.set()
            camera.join()

    def test_training_is_cancelled(self):
        captured = os.path.join(self.node.datasets, "captured")
        os.makedirs(captured, exist_ok=True)
        shutil.copy(os.path.join(self.node.datasets, "thing.pcd"), captured)
        self.write_dataset("captured/dataset.yaml", [
            {"object": "thing_%d" % i, "cloud": "thing.pcd", "kind": "view"} for i in range(3000)])
        old = self.succeed("load_codebook", "synthetic.sks").codebook
        try:
            self.press_buttons_of("CancelsATraining")
        finally:
            shutil.rmtree(captured)
        self.assertEqual(self.succeed("info").codebook, old)
        self.wait_for_status(lambda s: s.state not in (Status.TRAINING, Status.NO_CODEBOOK), "the end of the training")


if __name__ == "__main__":
    rospy.init_node("rviz_panel_with_node_test")
    rostest.rosrun("sks_detector", "rviz_panel_with_node", RvizPanelWithNodeTest)
