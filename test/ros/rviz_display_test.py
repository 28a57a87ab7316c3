#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the display sks_detector/Detections draws in a real rviz, on a screen in memory drawn by software."""
import os
import shutil
import signal
import subprocess
import tempfile
import unittest

import numpy as np
import rospy
import rostest
import yaml

import screen
import support
from sks_detector.msg import Detection, DetectionArray, ObjectModel, ObjectModels, Status

OBJECTS = ["cup", "box", "can"]  # of the codebook
PALETTE = {"cup": (0xf0, 0x78, 0x00), "box": (0x18, 0xa8, 0xf0), "can": (0x00, 0xc0, 0x08)}
BACKGROUND = (11, 22, 33)
THRESHOLD = 0.5
DISTANCE = 2.0  # of the eye, which looks along x, z up [m]
CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def configuration(**properties):
    display = {"Class": "sks_detector/Detections", "Name": "Detections", "Enabled": True, "Topic": "/detector/detections",
               "Threshold": THRESHOLD, "Timeout": 0}
    display.update(properties)
    view = {"Class": "rviz/Orbit", "Name": "Current View", "Target Frame": "<Fixed Frame>", "Distance": DISTANCE,
            "Focal Point": {"X": 0, "Y": 0, "Z": 0}, "Pitch": 0, "Yaw": 3.14159265, "Near Clip Distance": 0.01}
    return {"Panels": [], "Visualization Manager": {
        "Displays": [display], "Views": {"Current": view}, "Tools": [{"Class": "rviz/MoveCamera"}],
        "Global Options": {"Background Color": "%d; %d; %d" % BACKGROUND, "Fixed Frame": "map", "Frame Rate": 30}},
        "Window Geometry": {"Width": 800, "Height": 600, "Hide Left Dock": True, "Hide Right Dock": True}}


def detection(name="box", score=0.9, place=(0, 0, 0), size=(0.3, 0.2, 0.4), turn=0.0):
    """A box turned about z [radians]."""
    message = Detection(object=name, score=score)
    message.box_center.position.x, message.box_center.position.y, message.box_center.position.z = place
    message.box_center.orientation.z, message.box_center.orientation.w = np.sin(turn / 2), np.cos(turn / 2)
    message.pose.pose = message.box_center
    message.box_size.x, message.box_size.y, message.box_size.z = size
    return message


def corners_of(message):
    """In the frame of the message: 8 x 3 [m]."""
    size = message.box_size
    return support.matrix_of(message.box_center)[:3] @ np.column_stack(
        [CORNERS * (size.x, size.y, size.z), np.ones(8)]).T


def extent(mask, least=1):
    """First and last column and row in which at least so many pixels are set."""
    columns, rows = np.flatnonzero(mask.sum(0) >= least), np.flatnonzero(mask.sum(1) >= least)
    return np.array([columns[0], columns[-1], rows[0], rows[-1]])


@unittest.skipUnless(screen.AVAILABLE, "needs Xvfb and ImageMagick")
class RvizDisplayTest(unittest.TestCase):
    def start(self, **properties):
        """rviz, with these properties of the display."""
        self.folder = tempfile.mkdtemp(prefix="sks_rviz_")
        self.addCleanup(shutil.rmtree, self.folder)
        config = os.path.join(self.folder, "display.rviz")
        with open(config, "w") as file:
            yaml.safe_dump(configuration(**properties), file)
        self.publisher = rospy.Publisher("/detector/detections", DetectionArray, queue_size=10)
        self.addCleanup(self.publisher.unregister)
        status = rospy.Publisher("/detector/status", Status, queue_size=1, latch=True)
        self.addCleanup(status.unregister)
        status.publish(Status(objects=OBJECTS))
        self.screen = screen.Screen()
        self.addCleanup(self.screen.close)
        self.rviz = subprocess.Popen(["rviz", "-d", config], env=self.screen.environment)
        self.addCleanup(self.end)
        support.wait_for(lambda: self.publisher.get_num_connections() > 0, "rviz", 120)
        support.wait_for(lambda: self.like(BACKGROUND).sum() > 100000, "its window", 120)

    def end(self):
        self.rviz.send_signal(signal.SIGINT)
        self.rviz.wait(support.PATIENCE)

    def like(self, color):
        return self.screen.like(np.array(color) / 255)

    def shade_of(self, color):
        """Where the screen has a colour, or a darker one of its kind, as on a sphere."""
        picture, color = self.screen.picture(), np.array(color)
        level = picture[..., np.argmax(color)] / color.max()
        return (level > 0.3) & (level < 1.05) & (np.abs(picture - level[..., None] * color).max(2) <= 12)

    def publish(self, *detections, frame="map"):
        array = DetectionArray(detections=list(detections))
        array.header.frame_id, array.header.stamp = frame, rospy.Time.now()
        self.publisher.publish(array)

    def seen(self, *names):
        """Which objects are on the screen, by the colours of their edges."""
        return {name for name in PALETTE if self.like(PALETTE[name]).sum() > 50}

    def expect(self, names, *detections, frame="map"):
        def shown():
            self.assertIsNone(self.rviz.poll(), "rviz has ended")
            self.publish(*detections, frame=frame)
            return self.seen() == set(names)
        support.wait_for(shown, "%s on the screen" % (names,))

    def expected_extent(self, message):
        """Where rviz should draw a box, as extent()."""
        left, right, top, bottom = self.view
        focal_length = (bottom - top + 1) / 2 / np.tan(np.radians(45) / 2)
        x, y, z = corners_of(message)
        columns = (left + right + 1) / 2 - focal_length * y / (x + DISTANCE)
        rows = (top + bottom + 1) / 2 - focal_length * z / (x + DISTANCE)
        return np.array([columns.min(), columns.max(), rows.min(), rows.max()])

    def test_boxes_have_their_places_and_the_colours_of_the_codebook(self):
        self.start(Alpha=0, Axes="None", Labels=False)  # nothing but edges
        can = detection("can", 0.8, (0.1, 0.5, 0.2), turn=0.6)
        box = detection("box", 0.9, (-0.2, -0.4, -0.1), (0.2, 0.3, 0.3))
        self.expect(["can", "box"], box, can)
        self.view = extent(self.like(BACKGROUND), 200)  # once the window has its final size, without its icons
        for message in (can, box):
            found, expected = extent(self.like(PALETTE[message.object])), self.expected_extent(message)
            np.testing.assert_allclose(found, expected, atol=5, err_msg=message.object)
        box.score = THRESHOLD - 0.01
        self.expect(["can"], can, box)
        can.box_center.position.y = -0.5  # moved
        self.expect(["can"], can)
        support.wait_for(lambda: np.allclose(extent(self.like(PALETTE["can"])), self.expected_extent(can), atol=5),
                         "the box at its new place")
        self.expect([])

    def test_models_are_drawn_where_they_are_known(self):
        """Flat models across the view, off their boxes: 0.2 m wide and 0.1 m high, and a line."""
        row = np.arange(-0.1, 0.1001, 0.005)
        sheet = np.array([[0, y, z + 0.3] for y in row for z in row[10:31]])
        own = np.tile((200, 0, 200), (len(sheet), 1))
        models = rospy.Publisher("/detector/models", ObjectModels, queue_size=1, latch=True)
        self.addCleanup(models.unregister)
        models.publish(ObjectModels(models=[
            ObjectModel(object="can", view="can.obj", spacing=0.005, points=support.cloud_message(sheet, colors=own)),
            ObjectModel(object="cup", view="cup.obj", spacing=0.005, points=support.cloud_message(sheet * (1, 1, 0)))]))
        self.start(Alpha=0, Axes="None", Labels=False, Shape="Model", **{"Color By": "Model"})
        can, cup, box = detection("can"), detection("cup", place=(0, 0.4, -0.3)), detection("box", place=(0, -0.5, 0))
        can.view, cup.view, box.view = "can.obj", "cup.obj", "box.obj"
        cup.pose.pose.orientation.x = cup.pose.pose.orientation.w = np.sqrt(0.5)  # about x: wide becomes high

        def drawn():
            self.publish(can, cup, box)
            return (self.shade_of((200, 0, 200)).sum() > 1000 and self.shade_of(PALETTE["cup"]).sum() > 50 and
                    self.like(PALETTE["box"]).sum() > 50)
        support.wait_for(drawn, "the models and the box that has none")
        self.view = extent(self.like(BACKGROUND), 200)
        self.assertEqual(self.like(PALETTE["can"]).sum(), 0, "its edges are drawn")
        for color, place, size in (((200, 0, 200), (0, 0, 0.3), (0, 0.2, 0.1)), (PALETTE["cup"], (0, 0.4, -0.3), (0, 0, 0.2))):
            np.testing.assert_allclose(extent(self.shade_of(color)), self.expected_extent(detection(place=place, size=size)),
                                       atol=6)

    def test_goes_on_after_arrays_that_cannot_be_drawn(self):
        self.start()
        nan, zero, long, huge, negative = (detection() for _ in range(5))
        nan.box_center.position.x = nan.score = float("nan")
        zero.box_center.orientation.w = zero.pose.pose.orientation.w = 0
        long.box_center.orientation.w = 3
        huge.box_center.position.y = 1e38
        negative.box_size.x = -1
        names = [detection("\n\t\x01 Tasse mit Ei\xdf \u676f " + 1000 * "x"), detection("")]
        bad = [nan, zero, huge, negative]
        self.expect(["can"], *bad, detection("can"))
        self.publish(*names)
        self.expect(["box"], long)
        self.publish(*(3000 * [detection("cup")]))
        self.expect(["can"], detection("can"))
        for frame in ("nowhere", "", "/", "with space"):
            self.publish(detection("box"), frame=frame)
        self.expect(["box"], detection("box"), detection("can", 0.1))
        self.assertIsNone(self.rviz.poll())

    def test_many_arrays_a_second_need_no_more_memory(self):
        self.start()

        def stream(seconds):
            rate, end = rospy.Rate(200), rospy.get_time() + seconds
            count = 0
            while rospy.get_time() < end:
                count += 1
                self.publish(*(detection("thing %d" % ((i + count) % 40), 0.9, (0, 0.02 * i, 0)) for i in range(count % 20)))
                rate.sleep()
        self.expect(["can"], detection("can"))
        stream(10)
        before = support.memory_of(self.rviz.pid)
        stream(20)
        self.assertLess(support.memory_of(self.rviz.pid) - before, 15)  # [MB]
        self.expect(["can"], detection("can"))


if __name__ == "__main__":
    rospy.init_node("rviz_display_test")
    rostest.rosrun("sks_detector", "rviz_display", RvizDisplayTest)
