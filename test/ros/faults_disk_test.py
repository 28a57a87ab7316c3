#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Disks that are full or read-only, under a node that runs: requests are refused, nothing is lost, frames go on."""
import os
import subprocess
import unittest

import rospy
import rostest

import services_support
import support
import synthetic

FULL, READ_ONLY = "No space left on device", "Read-only file system; choose a folder that can be written to"


class FaultyDiskTest(services_support.ServicesTest):
    def setUp(self):
        self.loaded = self.succeed("load_codebook", "synthetic.sks").codebook

    def mount(self, folder, size):
        """A disk of so many bytes."""
        os.makedirs(folder, exist_ok=True)
        options = ["-t", "tmpfs", "-o", "size=%d" % size]
        if subprocess.call(["mount", *options, "tmpfs", folder], stderr=subprocess.DEVNULL):
            raise unittest.SkipTest("only root may mount a small disk")
        self.addCleanup(subprocess.check_call, ["umount", folder])
        return folder

    def make_read_only(self, folder, how="ro"):
        subprocess.check_call(["mount", "-o", "remount," + how, folder])

    def disk_for_one_codebook(self):
        """It holds one already: its path and what is in it."""
        disk = self.mount(os.path.join(self.node.codebooks, "disk"), 1.5 * os.path.getsize(support.CODEBOOK))
        self.succeed("save_codebook", "disk/toys.sks", False)
        return disk, os.path.join(disk, "toys.sks"), self.content(os.path.join(disk, "toys.sks"))

    def content(self, path):
        with open(path, "rb") as file:
            return file.read()

    def expect_the_old_codebook(self):
        self.assertEqual(self.succeed("info").codebook, self.loaded)
        found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual(sorted(d.object for d in found.detections), ["round", "thing"])

    def test_codebooks_on_a_full_disk(self):
        disk, path, before = self.disk_for_one_codebook()
        self.refuse("save_codebook", os.path.join(disk, "other.sks"), FULL, path="disk/other.sks")
        self.refuse("train", path, FULL, dataset="synthetic.yaml", name="new", output="disk/toys.sks", overwrite=True)
        self.assertEqual(os.listdir(disk), ["toys.sks"])
        self.assertEqual(self.content(path), before)
        self.expect_the_old_codebook()
        os.remove(path)
        self.succeed("save_codebook", "disk/other.sks", False)

    def test_codebooks_on_a_read_only_disk(self):
        disk, path, before = self.disk_for_one_codebook()
        self.make_read_only(disk)
        self.refuse("save_codebook", READ_ONLY, path="disk/other.sks")
        self.refuse("train", READ_ONLY, dataset="synthetic.yaml", name="new", output="disk/toys.sks", overwrite=True)
        self.assertEqual(self.content(path), before)
        self.expect_the_old_codebook()
        self.assertEqual(self.succeed("load_codebook", "disk/toys.sks").codebook, self.loaded)
        self.make_read_only(disk, "rw")
        os.remove(path)  # there is no room for the old one and the new one
        self.succeed("train", dataset="synthetic.yaml", name="new", output="disk/toys.sks", overwrite=True)

    def test_captured_views_on_a_full_and_on_a_read_only_disk(self):
        disk = self.mount(os.path.join(self.node.datasets, "captured"), 200000)
        points = services_support.tabletop(services_support.standing(synthetic.THING, 0.05))
        stored = 0
        while self.capture(points, "thing").success:
            stored += 1
        self.assertGreater(stored, 0)
        self.refuse_capture(points, FULL, stored)
        self.make_read_only(disk)
        self.refuse_capture(points, "Read-only file system", stored)
        self.expect_the_old_codebook()
        self.assertEqual(self.succeed("train", captured=True).views, stored)

    def refuse_capture(self, points, reason, stored):
        """And all views that were captured are there, and nothing else."""
        reply = self.capture(points, "thing")
        self.assertFalse(reply.success)
        self.assertIn(reason, reply.message)
        views = os.listdir(os.path.join(self.node.datasets, "captured", "thing"))
        self.assertEqual(sorted(views), ["%03d.pcd" % number for number in range(stored)])


if __name__ == "__main__":
    rospy.init_node("faults_disk_test")
    rostest.rosrun("sks_detector", "faults_disk", FaultyDiskTest)
