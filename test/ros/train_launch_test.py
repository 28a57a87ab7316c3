#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""train.launch trains a data set and ends, or says why it cannot."""
import os
import shutil
import subprocess
import tempfile
import unittest

import rostest

import support


class TrainLaunchTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="sks_train_")
        self.addCleanup(shutil.rmtree, self.folder)

    def train(self, *arguments):
        """What the launch file prints; it ends by itself."""
        return subprocess.run(
            ["roslaunch", "sks_detector", "train.launch", "keep:=false", "folder:=" + self.folder,
             "datasets:=" + support.DATA, "name:=trainer"] + list(arguments),
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=2 * support.PATIENCE).stdout

    def test_trains_a_data_set_and_ends(self):
        printed = self.train("dataset:=synthetic.yaml", "output:=new.sks")
        self.assertRegex(printed, r"detecting with synthetic \([0-9a-f]{8}\): 2 objects, 2 views")
        subprocess.check_call(["rosrun", "sks_detector", "sks", "verify", os.path.join(self.folder, "new.sks")])
        self.assertIn("exists already", self.train("dataset:=synthetic.yaml", "output:=new.sks"))
        self.assertNotIn("exists already", self.train("dataset:=synthetic.yaml", "output:=new.sks", "overwrite:=true"))

    def test_says_what_is_missing(self):
        self.assertIn("missing.yaml", self.train("dataset:=missing.yaml"))
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "train_launch", TrainLaunchTest)
