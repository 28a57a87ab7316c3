#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Launches replay.launch on a simulated bag, on a recorded one and in a loop: what it finds, and how it ends."""
import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

import numpy as np
import rosbag
import rostest

import support

POINTS = "/camera/depth_registered/points"
RECORDED = os.path.join(os.environ.get("SKS_DATA", ""), "bags", "watercan.bag")


def sks(*arguments):
    return subprocess.run(["rosrun", "sks_detector", "sks", *arguments], check=True, stdout=subprocess.PIPE,
                          universal_newlines=True).stdout


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def launch(folder, **arguments):
    """The running launch; its messages go to `launch.log` in the folder."""
    port = str(free_port())
    environment = dict(os.environ, ROS_MASTER_URI="http://localhost:" + port, ROS_HOSTNAME="localhost",
                       ROS_LOG_DIR=os.path.join(folder, "log"))
    command = ["roslaunch", "--port", port, "sks_detector", "replay.launch"]
    command += ["%s:=%s" % item for item in arguments.items()]
    with open(os.path.join(folder, "launch.log"), "w") as log:
        return subprocess.Popen(command, env=environment, stdout=log, stderr=subprocess.STDOUT)


class ReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.data = tempfile.mkdtemp()
        meshes = ["--mesh", "drill=builtin:drill", "--mesh", "duck=builtin:duck"]
        sks("simulate", "--output", cls.data, *meshes, "--scenes", "2", "--objects", "2", "--distractors", "1",
            "--bag", "--rate", "0.25")
        sks("train", *meshes, "--output", os.path.join(cls.data, "objects.sks"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.data)

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.found = os.path.join(self.folder, "found.bag")

    def end_of(self, process):
        """Waits for the end of a launch and checks that it was a good one."""
        try:
            status = process.wait(3 * support.PATIENCE)  # starts, plays in real time, and ends
        finally:
            if process.poll() is None:
                process.kill()
        with open(os.path.join(self.folder, "launch.log")) as file:
            log = file.read()
        self.assertEqual(status, 0, log)
        for sign in ("[ERROR]", "[FATAL]", "Traceback", "exit code", "escalating", "terminate called"):
            self.assertNotIn(sign, log)

    def replay(self, **arguments):
        """The clouds' headers, and the detections by stamp, of a replay to its end."""
        self.end_of(launch(self.folder, record=self.found, delay=4, linger=8, **arguments))
        clouds, arrays = [], {}
        with rosbag.Bag(self.found) as bag:
            for topic, message, _ in bag.read_messages():
                if topic == "/detector/detections":
                    self.assertNotIn(message.header.stamp, arrays)
                    arrays[message.header.stamp] = message
                elif message._type == "sensor_msgs/PointCloud2":
                    clouds.append(message.header)
        return clouds, arrays

    def test_finds_what_stands_in_a_simulated_bag(self):
        bag = os.path.join(self.data, "scenes.bag")
        clouds, arrays = self.replay(bag=bag, codebook=os.path.join(self.data, "objects.sks"))
        self.assertEqual(len(clouds), 2)
        self.assertEqual(sorted(arrays), sorted(header.stamp for header in clouds))
        found_of = dict.fromkeys(("drill", "duck"), 0)
        with rosbag.Bag(bag) as truth:
            for _, message, _ in truth.read_messages("/ground_truth"):
                array = arrays[message.header.stamp]
                self.assertEqual(array.header.frame_id, message.header.frame_id)
                self.assertTrue(array.codebook.startswith("meshes ("), array.codebook)
                for true in message.detections:
                    near = [d for d in array.detections if d.object == true.object and np.linalg.norm(
                        support.position_of(d.box_center) - support.position_of(true.box_center)) < 0.01]
                    self.assertLessEqual(len(near), 1)
                    found_of[true.object] += len(near)
        self.assertEqual(found_of, {"drill": 2, "duck": 2})

        result = json.loads(sks("bag", "evaluate", self.found, "--json", "-"))
        self.assertEqual(result["scenes"], 2)
        self.assertEqual(result["unanswered"], 0)
        self.assertEqual(result["true_positives"], 4)
        self.assertLess(result["pose"]["rotation_error_deg"]["median"], 5)

    @unittest.skipUnless(os.path.isfile(RECORDED), "no recorded bag in SKS_DATA")
    def test_plays_a_recorded_bag_with_another_frame_and_topic(self):
        topic = "/euclidean_cluster_indices_decomposer/output00"
        clouds, arrays = self.replay(bag=RECORDED, codebook=support.CODEBOOK, points=topic, rate=4)
        self.assertEqual([header.frame_id for header in clouds], ["/ground"])
        self.assertEqual(list(arrays), [clouds[0].stamp])
        self.assertEqual(arrays[clouds[0].stamp].header.frame_id, "ground")

    def test_a_loop_goes_on_until_it_is_interrupted(self):
        bag = os.path.join(self.data, "scenes.bag")
        process = launch(self.folder, bag=bag, codebook=support.CODEBOOK, loop="true", rate=8, linger=0,
                         record=self.found)
        self.addCleanup(process.kill)
        # the bag lasts half a second at this rate: what holds four frames has begun anew
        size = 1.8 * os.path.getsize(bag)
        support.wait_for(lambda: os.path.exists(self.found + ".active")
                         and os.path.getsize(self.found + ".active") > size, "the second round")
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        self.end_of(process)
        self.assertTrue(os.path.exists(self.found))


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "replay", ReplayTest)
