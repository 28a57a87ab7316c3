#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/soak, for three minutes: too short, on a busy machine, for limits as strict as its defaults."""
import re
import subprocess
import unittest

import rostest


class SoakTest(unittest.TestCase):
    def test_nothing_is_lost_and_nothing_grows(self):
        run = subprocess.run(["rosrun", "sks_detector", "soak", "--minutes", "3", "--warmup", "20", "--growth", "5",
                              "--lost", "10", "--slower", "1000"],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertEqual(run.returncode, 0, run.stdout)
        sent, received, processed, dropped = map(int, re.search(
            r"(\d+) sent, (\d+) received, (\d+) processed, (\d+) dropped", run.stdout).groups())
        self.assertEqual(sent, 2000)
        self.assertGreaterEqual(received, 1990)
        self.assertEqual(processed + dropped, received)
        self.assertIn("clouds of 640x480", run.stdout)
        self.assertIn("largest difference 0 ns", run.stdout)
        self.assertEqual(len(re.findall("^ok: ", run.stdout, re.M)), 8, run.stdout)

    def test_fails_where_memory_grows_too_much(self):
        run = subprocess.run(["rosrun", "sks_detector", "soak", "--minutes", "0.03", "--warmup", "1", "--growth", "-100",
                              "--lost", "10", "--slower", "1000"],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertIn("NOT TRUE:  memory grows by no more than -100 %", run.stdout)


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "soak", SoakTest)
