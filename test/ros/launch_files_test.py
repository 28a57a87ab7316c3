#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every shipped launch file can be loaded and explains its arguments."""
import glob
import os
import re
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

# The launch file and the arguments, of those that camera.launch gives, of each driver; they are shown as parameters.
DRIVERS = {
    "openni2_launch": ("openni2", ("camera", "device_id", "depth_registration", "rgb_frame_id", "respawn")),
    "freenect_launch": ("freenect", ("camera", "device_id", "depth_registration", "rgb_frame_id", "respawn")),
    "realsense2_camera": ("rs_camera", ("camera", "serial_no", "align_depth", "depth_width", "depth_fps", "color_height",
                                        "enable_sync")),
    "azure_kinect_ros_driver": ("driver", ("sensor_sn", "depth_mode", "color_resolution", "fps", "point_cloud",
                                           "rgb_point_cloud", "point_cloud_in_depth_frame")),
    "zed_wrapper": ("zed2", ("camera_name", "svo_file")),
    "astra_camera": ("astra", ("camera_name", "serial_number", "depth_registration", "enable_point_cloud_xyzrgb")),
}


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

    def test_machines_of_the_guide_have_their_own_nodes_and_frames(self):
        with open(os.path.join(PACKAGE, "docs", "scaling.md")) as file:
            text = re.search(r"^<launch>.*?^</launch>$", file.read(), re.MULTILINE | re.DOTALL).group()
        config = roslaunch.config.ROSLaunchConfig()
        roslaunch.xmlloader.XmlLoader(resolve_anon=True).load_string(text, config, verbose=False)
        self.assertEqual(config.config_errors, [])
        self.assertEqual({machine.name for machine in config.machines.values()} & {"left", "right"}, {"left", "right"})
        self.assertEqual({(node.namespace.strip("/"), node.name, node.machine_name) for node in config.nodes},
                         {(side, name, side) for side in ("left", "right") for name in ("camera", "detector", "sks_manager")})
        for side in ("left", "right"):
            self.assertEqual(config.params["/%s/camera/frame_id" % side].value, side + "_optical_frame")
            self.assertEqual(config.params["/%s/detector/tf_prefix" % side].value, side)
            remaps = [remap for node in config.nodes if node.machine_name == side for remap in node.remap_args]
            self.assertIn(["~points", "/%s/camera/points" % side], remaps)

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

    def environment_with(self, drivers):
        """Variables with which these drivers are found."""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        for driver in drivers:
            launch, arguments = DRIVERS[driver]
            os.makedirs(os.path.join(folder, driver, "launch"))
            with open(os.path.join(folder, driver, "package.xml"), "w") as file:
                file.write("<package><name>%s</name></package>" % driver)
            with open(os.path.join(folder, driver, "launch", launch + ".launch"), "w") as file:
                shown = " ".join("%s=$(arg %s)" % (name, name) for name in arguments)
                file.write("<launch>%s<param name=\"seen\" value=\"%s\"/></launch>" % (
                    "".join('<arg name="%s" default="none"/>' % name for name in arguments), shown))
        return dict(os.environ, ROS_PACKAGE_PATH=folder + ":" + os.environ["ROS_PACKAGE_PATH"])

    def test_each_driver_is_included_where_it_is_installed(self):
        environment = self.environment_with(DRIVERS)

        def roslaunch_says(what, name, *arguments):
            return subprocess.check_output(["roslaunch", what, "sks_detector", name, *arguments], env=environment,
                                           universal_newlines=True)
        openni = "camera=head device_id=%s depth_registration=true rgb_frame_id=camera_rgb_optical_frame respawn=false"
        for driver, parameter, seen, points, sensor_frame in (
                ("openni2_launch", "/seen", openni % "#2", "/head/depth_registered/points", ""),
                ("freenect_launch", "/seen", openni % "#2", "/head/depth_registered/points", ""),
                ("realsense2_camera", "/seen", "camera=head serial_no=#2 align_depth=true depth_width=640 depth_fps=30 "
                 "color_height=480 enable_sync=true", "/head/depth_registered/points", ""),
                ("azure_kinect_ros_driver", "/head/seen", "sensor_sn=#2 depth_mode=NFOV_UNBINNED color_resolution=720P "
                 "fps=30 point_cloud=true rgb_point_cloud=true point_cloud_in_depth_frame=true", "/head/points2", ""),
                ("zed_wrapper", "/seen", "camera_name=head svo_file=#2", "/head/zed_node/point_cloud/cloud_registered",
                 "head_left_camera_optical_frame"),
                ("astra_camera", "/seen", "camera_name=head serial_number=#2 depth_registration=true "
                 "enable_point_cloud_xyzrgb=true", "/head/depth_registered/points", "")):
            arguments = ("driver:=" + driver, "camera:=head", "device:=#2", "respawn:=false")
            with self.subTest(driver):
                for name in ("camera.launch", "robot.launch"):
                    parameters = yaml.safe_load(roslaunch_says("--dump-params", name, *arguments))
                    self.assertEqual(parameters[parameter], seen)
                self.assertEqual(parameters["/detector/sensor_frame"], sensor_frame)
                nodes = ["/detector", "/sks_manager"]
                converter = ["/head_points"] if driver == "realsense2_camera" else []
                self.assertEqual(roslaunch_says("--nodes", "camera.launch", *arguments).split(), converter)
                self.assertEqual(sorted(roslaunch_says("--nodes", "robot.launch", *arguments).split()), nodes[:1] +
                                 converter + nodes[1:])
                self.assertIn("~points:=" + points, roslaunch_says("--args=/detector", "robot.launch", *arguments))

    def test_an_unknown_driver_and_one_that_is_not_installed_are_refused(self):
        for driver, reason in (("realsense", "the driver 'realsense' is unknown; choose openni2, "),
                               ("zed_wrapper", "Resource not found: zed_wrapper")):
            for name in ("camera.launch", "robot.launch"):
                with self.subTest(driver + " in " + name):
                    result = subprocess.run(["roslaunch", "--nodes", "sks_detector", name, "driver:=" + driver],
                                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
                    self.assertNotEqual(result.returncode, 0)
                    self.assertIn(reason, result.stdout)


if __name__ == "__main__":
    rostest.rosrun("sks_detector", "launch_files", LaunchFilesTest)
