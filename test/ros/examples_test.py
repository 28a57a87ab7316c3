#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the example subscribers print of what the node finds."""
import re
import subprocess
import sys
import unittest

import numpy as np
import roslib.packages
import rospy
import rostest
from sensor_msgs.msg import PointCloud2

import support
import synthetic


class ExamplesTest(unittest.TestCase):
    def printed(self, type_name, prefix=()):
        """The lines that an example prints of a scene with two objects, sorted."""
        program = roslib.packages.find_node("sks_detector", type_name)
        self.assertTrue(program, "%s is not in the package" % type_name)
        process = subprocess.Popen([*prefix, program[0], "__name:=" + type_name.replace(".", "_")],
                                   stdout=subprocess.PIPE, universal_newlines=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        # again and again: what the node finds before the example is connected, nobody hears
        clouds = rospy.Publisher("/points", PointCloud2, queue_size=1)
        scene = synthetic.scene()
        timer = rospy.Timer(rospy.Duration(0.5), lambda _: clouds.publish(support.cloud_message(scene)))
        self.addCleanup(clouds.unregister)
        self.addCleanup(timer.shutdown)
        return sorted(process.stdout.readline() for _ in range(2))

    def expect_both(self, lines):
        for name, line in zip(("round", "thing"), lines):
            found = re.match(r"(\w+), score (\d\.\d\d), at (\S+) (\S+) (\S+) m in camera\n$", line)
            self.assertTrue(found, line)
            self.assertEqual(found.group(1), name)
            self.assertTrue(0.5 <= float(found.group(2)) <= 1, line)
            np.testing.assert_allclose([float(found.group(i)) for i in (3, 4, 5)], synthetic.position(name), atol=0.01)

    def test_cpp_subscriber(self):
        self.expect_both(self.printed("ros_subscriber"))

    def test_python_subscriber(self):
        self.expect_both(self.printed("ros_subscriber.py", [sys.executable]))


if __name__ == "__main__":
    rospy.init_node("examples_test")
    rostest.rosrun("sks_detector", "examples", ExamplesTest)
