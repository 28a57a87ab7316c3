#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every shipped launch file can be loaded and explains its arguments."""
import glob
import os
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import roslaunch.config
import roslaunch.xmlloader
import rospkg
import rostest
import yaml

PACKAGE = rospkg.RosPack().get_path("sks_detector")
FILES = sorted(glob.glob(os.path.join(PACKAGE, "launch", "*.launch")))

# Takes the arguments of the real one that camera.launch gives, and shows them as parameters.
OPENNI2_LAUNCH = """<launch>
  <arg name="camera"/> <arg name="device_id"/> <arg name="depth_registration"/> <arg name="rgb_frame_id"/>
  <arg name="respawn"/>
  <param name="seen" value="$(arg camera) $(arg device_id) $(arg depth_registration) $(arg rgb_frame_id) $(arg respawn)"/>
</launch>"""


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

    def test_machine_is_that_of_every_node(self):
        text = """<launch>
          <machine name="robot" address="robot.local" env-loader="/opt/env.sh"/>
          <include file="%s"> <arg name="machine" value="robot"/> </include>
        </launch>"""
        for name in ("camera", "detector", "robot", "depth_images"):
            with self.subTest(name):
                config = roslaunch.config.ROSLaunchConfig()
                file = os.path.join(PACKAGE, "launch", name + ".launch")
                roslaunch.xmlloader.XmlLoader(resolve_anon=True).load_string(text % file, config, verbose=False)
                self.assertGreaterEqual(len(config.nodes), 2)
                self.assertEqual({node.machine_name for node in config.nodes}, {"robot"})

    def test_both_configurations_of_rviz_show_the_same_without_keypoints_at_first(self):
        displays = []
        for path in sorted(glob.glob(os.path.join(PACKAGE, "config", "*.rviz"))):
            with open(path) as file:
                displays.append({d["Name"]: d for d in yaml.safe_load(file)["Visualization Manager"]["Displays"]})
            self.assertFalse(displays[-1]["Keypoints"]["Enabled"])
            self.assertEqual(displays[-1]["Picture"]["Class"], "rviz/Image")
            self.assertEqual(displays[-1]["TF"]["Class"], "rviz/TF")
            self.assertEqual(displays[-1].pop("Grid")["Class"], "rviz/Grid")  # lies across the axis that points up
        self.assertEqual(len(displays), 2)
        self.assertEqual(*displays)

    def test_rviz_opens_with_the_view_for_its_frame(self):
        for frame, file in (("camera_rgb_optical_frame", "sks_detector.rviz"), ("base_link", "sks_detector_robot.rviz")):
            config = roslaunch.config.ROSLaunchConfig()
            roslaunch.xmlloader.XmlLoader(resolve_anon=True).load(
                os.path.join(PACKAGE, "launch", "rviz.launch"), config, argv=["fixed_frame:=" + frame], verbose=False)
            self.assertIn("/config/%s -f %s" % (file, frame), config.nodes[0].args)

    def test_openni2_launch_is_used_where_it_is_asked_for(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        os.makedirs(os.path.join(folder, "openni2_launch", "launch"))
        with open(os.path.join(folder, "openni2_launch", "package.xml"), "w") as file:
            file.write("<package><name>openni2_launch</name></package>")
        with open(os.path.join(folder, "openni2_launch", "launch", "openni2.launch"), "w") as file:
            file.write(OPENNI2_LAUNCH)
        environment = dict(os.environ, ROS_PACKAGE_PATH=folder + ":" + os.environ["ROS_PACKAGE_PATH"])

        def roslaunch_says(what, name, *arguments):
            return subprocess.check_output(["roslaunch", what, "sks_detector", name, "driver:=openni2_launch", *arguments],
                                           env=environment, universal_newlines=True)
        for arguments, seen in (((), "camera #1 true camera_rgb_optical_frame true"),
                                (("camera:=head", "device:=#2", "respawn:=false"),
                                 "head #2 true camera_rgb_optical_frame false")):
            for name in ("camera.launch", "robot.launch"):
                parameters = yaml.safe_load(roslaunch_says("--dump-params", name, *arguments))
                self.assertEqual(parameters["/seen"], seen)
        self.assertEqual(roslaunch_says("--nodes", "camera.launch").split(), [])
        self.assertEqual(sorted(roslaunch_says("--nodes", "robot.launch").split()), ["/detector", "/sks_manager"])


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "launch_files", LaunchFilesTest)
