#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every shipped launch file can be loaded and explains its arguments."""
import glob
import os
import unittest
import xml.etree.ElementTree

import roslaunch.config
import roslaunch.xmlloader
import rospkg
import rostest

PACKAGE = rospkg.RosPack().get_path("sks_detector")
FILES = sorted(glob.glob(os.path.join(PACKAGE, "launch", "*.launch")))


class LaunchFilesTest(unittest.TestCase):
    def test_there_are_launch_files(self):
        self.assertGreaterEqual(len(FILES), 4)

    def test_every_argument_has_a_doc(self):
        for path in FILES:
            for arg in xml.etree.ElementTree.parse(path).getroot().iter("arg"):
                if "value" not in arg.attrib:
                    with self.subTest("%s: %s" % (os.path.basename(path), arg.get("name"))):
                        self.assertTrue(arg.get("doc"))

    def test_every_file_loads(self):
        for path in FILES:
            with self.subTest(os.path.basename(path)):
                required = [arg.get("name") for arg in xml.etree.ElementTree.parse(path).getroot().findall("arg")
                            if "value" not in arg.attrib and "default" not in arg.attrib]
                loader = roslaunch.xmlloader.XmlLoader(resolve_anon=True)
                config = roslaunch.config.ROSLaunchConfig()
                loader.load(path, config, argv=["%s:=/some/%s" % (name, name) for name in required], verbose=False)
                self.assertTrue(config.nodes)
                self.assertEqual(config.config_errors, [])
                config.assign_machines()
                for node in config.nodes:
                    rospkg.RosPack().get_path(node.package)


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "launch_files", LaunchFilesTest)
