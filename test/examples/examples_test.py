#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the examples and reads what they print: examples_test.py FOLDER_OF_THE_PROGRAMS [TEST]"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "ros"))
import synthetic  # noqa: E402

PROGRAMS = ""
BOXES = [solid for solid in synthetic.THING if solid[0] == synthetic.BOX]


def write_pcd(path, points):
    """An organised, grey cloud."""
    height, width = points.shape[:2]
    with open(path, "w") as file:
        file.write("VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH %d\nHEIGHT %d\n"
                   "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA ascii\n" % (width, height, width * height))
        for point in points.reshape(-1, 3):
            file.write("%.6f %.6f %.6f 8421504\n" % tuple(point))


def write_obj(path, boxes):
    """Boxes as a mesh of triangles."""
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    with open(path, "w") as file:
        for _, center, half in boxes:
            for corner in corners:
                file.write("v %g %g %g\n" % tuple(np.array(center) + np.array(half) * corner))
        for i in range(len(boxes)):
            for a, b, c, d in quads:
                for triangle in ((a, b, c), (a, c, d)):
                    file.write("f %d %d %d\n" % tuple(8 * i + k + 1 for k in triangle))


class ExamplesTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def run_example(self, name, *arguments, status=0):
        run = subprocess.run([os.path.join(PROGRAMS, name), *arguments], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, universal_newlines=True, check=False)
        self.assertEqual(run.returncode, status, run.stderr)
        return run.stdout if status == 0 else run.stderr

    def train(self):
        write_obj(self.path("thing.obj"), BOXES)
        return self.run_example("train_mesh", "thing", self.path("thing.obj"), self.path("thing.sks"))

    def test_train_mesh(self):
        self.assertRegex(self.train(), r"thing\.sks: 1 object, 42 views, [1-9]\d\d+ codewords of shot\n$")
        self.assertTrue(os.path.getsize(self.path("thing.sks")) > 100000)
        self.assertIn("none.obj", self.run_example("train_mesh", "a", self.path("none.obj"), "a.sks", status=1))
        self.assertIn("usage: train_mesh", self.run_example("train_mesh", status=2))

    def test_detect_pcl(self):
        self.train()
        truth = synthetic.pose(50, (1, 2, 0.4), (0.03, 0.02, 0.8))
        write_pcd(self.path("scene.pcd"), synthetic.view([(BOXES, truth)]))
        found = self.run_example("detect_pcl", self.path("thing.sks"), self.path("scene.pcd"))
        head = re.match(r"thing (\S+)\n", found)
        self.assertTrue(head, found)
        self.assertTrue(0.5 <= float(head.group(1)) <= 1, found)
        lines = found[head.end():].splitlines()
        self.assertEqual(len(lines), 4, found)
        pose = np.array([[float(number) for number in line.split()] for line in lines])
        np.testing.assert_allclose(pose[:3, 3], truth[:3, 3], atol=0.01)
        difference = np.linalg.inv(truth) @ pose
        self.assertLess(np.degrees(np.arccos(min(1, (np.trace(difference[:3, :3]) - 1) / 2))), 5)

        for files in (["none.sks", "scene.pcd"], ["thing.sks", "none.pcd"]):
            message = self.run_example("detect_pcl", *map(self.path, files), status=1)
            self.assertIn(next(file for file in files if "none" in file), message)

    def test_own_keypoints(self):
        shape, moved = synthetic.THING, synthetic.pose(0, (0, 0, 1), (0.05, -0.02, 0.1))
        view = synthetic.view([(shape, synthetic.TRAINED["thing"])])
        write_pcd(self.path("view.pcd"), view)
        write_pcd(self.path("scene.pcd"), synthetic.apply(moved, view.reshape(-1, 3)).reshape(view.shape))
        found = self.run_example("own_keypoints", self.path("view.pcd"), self.path("scene.pcd"))
        match = re.match(r"object, score (\S+), at +(\S+) +(\S+) +(\S+) m\n$", found)
        self.assertTrue(match, found)
        self.assertTrue(0.5 <= float(match.group(1)) <= 1, found)
        points = view.reshape(-1, 3)[np.isfinite(view.reshape(-1, 3)).all(1)]
        center = 0.5 * (points.min(0) + points.max(0)) + moved[:3, 3]
        np.testing.assert_allclose([float(match.group(i)) for i in (2, 3, 4)], center, atol=0.005)
        self.assertIn("none.pcd", self.run_example("own_keypoints", self.path("none.pcd"), "a", status=1))


if __name__ == "__main__":
    PROGRAMS = sys.argv.pop(1)
    unittest.main()
