#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""kill -9 of a node that trains or saves by service: it comes back with the old codebook or with the new one."""
import itertools
import os
import random
import shutil
import threading
import time

import rospy
import rostest

import services_support
import support
import synthetic

RUNS = int(os.environ.get("SKS_FAULT_RUNS", 4))
NAMES = ("first", "second")


class KilledNodeTest(services_support.ServicesTest):
    def test_leaves_the_old_codebook_or_the_new_one(self):
        longest = 1.1 * max(self.train_seconds(name) for name in NAMES)
        wholes = {self.content(name + ".sks"): name for name in NAMES}
        self.assertEqual(len(wholes), 2)
        shutil.copy(self.path("first.sks"), self.path("toys.sks"))
        rospy.set_param("/detector/codebook", self.path("toys.sks"))
        generator = random.Random(4)
        for run, work in zip(range(RUNS), itertools.cycle((self.train, self.save))):
            worker = threading.Thread(target=self.until_killed, args=(work,))
            worker.start()
            time.sleep(generator.uniform(0, longest))  # the moment is what is tested
            self.node.kill()
            worker.join()
            left = self.content("toys.sks")
            self.assertIn(left, wholes, "run %d" % run)
            self.node.start()
            self.assertTrue(self.succeed("info").codebook.startswith(wholes[left] + " ("))
            found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
            self.assertEqual(sorted(d.object for d in found.detections), ["round", "thing"])

    def train_seconds(self, name):
        return self.succeed("train", dataset="synthetic.yaml", name=name, output=name + ".sks").seconds

    def train(self, name):
        self.node.call("train", dataset="synthetic.yaml", name=name, output="toys.sks", overwrite=True)

    def save(self, name):
        self.node.call("load_codebook", path=name + ".sks")
        self.node.call("save_codebook", path="toys.sks", overwrite=True)

    def until_killed(self, work):
        try:
            for name in itertools.cycle(NAMES):
                work(name)
        except (rospy.ServiceException, rospy.ROSException):
            pass  # the node is gone

    def path(self, name):
        return os.path.join(self.node.codebooks, name)

    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()


if __name__ == "__main__":
    rospy.init_node("faults_kill_test")
    rostest.rosrun("sks_detector", "faults_kill", KilledNodeTest)
