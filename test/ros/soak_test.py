#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/soak, for SKS_SOAK_MINUTES, by default one. In a few minutes memory settles less, and latencies scatter more, than
in the half hour that the limits of the script are for."""
import os
import re
import subprocess
import unittest

import rostest

MINUTES = float(os.environ.get("SKS_SOAK_MINUTES", 1))
WARMUP = 90  # until each worker thread has seen each scene, and its buffers have grown [s]
LIMITS = [] if MINUTES >= 10 else ["--growth", "5", "--slower", "50"]


def soak(*arguments):
    return subprocess.run(["rosrun", "sks_detector", "soak", *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True)


class SoakTest(unittest.TestCase):
    def test_nothing_is_lost_nothing_grows_and_nothing_slows_down(self):
        run = soak("--minutes", str(MINUTES), "--warmup", str(WARMUP), *LIMITS)
        self.assertEqual(run.returncode, 0, run.stdout)
        sent, processed, dropped, lost, answers = map(int, re.search(
            r"(\d+) sent, (\d+) processed, (\d+) dropped for newer ones, (\d+) lost, (\d+) answers", run.stdout).groups())
        self.assertEqual(sent, round(10 * (60 * MINUTES + WARMUP)))
        self.assertEqual(lost, 0)
        self.assertEqual(processed + dropped, sent)
        self.assertEqual(answers, processed)
        self.assertIn("clouds of 640x480", run.stdout)
        self.assertIn("largest difference 0 ns", run.stdout)
        self.assertEqual(len(re.findall("^ok: ", run.stdout, re.M)), 8, run.stdout)
        print(run.stdout)

    def test_fails_where_memory_grows_or_the_end_is_slower_by_more_than_the_limits(self):
        run = soak("--minutes", "0.1", "--warmup", "1", "--growth", "-100", "--slower", "-100")
        self.assertEqual(run.returncode, 1, run.stdout)
        self.assertIn("NOT TRUE:  memory grows by no more than -100 %", run.stdout)
        self.assertRegex(run.stdout, "NOT TRUE:  p95 of the last .* s is no more than -100 % above that of the first")


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "soak", SoakTest)
