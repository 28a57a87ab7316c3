#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Training views from the camera: capture, train, detect; what is refused; restarts."""
import os
import re

import numpy as np
import rospy
import rostest

import services_support
import support
import synthetic
from services_support import standing, tabletop


class CaptureServicesTest(services_support.ServicesTest):
    def setUp(self):
        folder = self.file("")
        captured = [name for name in os.listdir(folder) if "." not in name] if os.path.exists(folder) else []
        for name in set(captured + self.succeed("info").objects):
            self.succeed("remove_object", name, True)

    def file(self, name):
        return os.path.join(self.node.datasets, "captured", name)

    def captured(self, *arguments, **fields):
        reply = self.capture(*arguments, **fields)
        self.assertTrue(reply.success, reply.message)
        return reply

    def test_captures_the_one_object(self):
        points = tabletop(standing(synthetic.THING, 0.05))
        reply = self.captured(points, "thing", services_support.colors_of(points))
        self.assertEqual(reply.view, self.file("thing/000.pcd"))
        self.assertEqual(reply.views, 1)
        self.assertIn("a good view", reply.message)
        self.assertGreater(reply.points, 1000)
        self.assertAlmostEqual(reply.extent.x, 0.165, delta=0.02)
        self.assertAlmostEqual(reply.resolution, 0.002, delta=0.0006)
        with open(reply.view, "rb") as file:
            header = file.read(400)
        self.assertIn(b"FIELDS x y z rgb\n", header)
        self.assertIn(b"VIEWPOINT 0 0 0 1 0 0 0\n", header)
        self.assertNotIn(b"HEIGHT 1\n", header)
        self.assertEqual(self.captured(points, "thing").view, self.file("thing/001.pcd"))
        self.wait_for_status(lambda s: s.captured == ["thing"], "the captured object in the status")

    def test_says_what_is_not_good_about_a_view(self):
        coarse = tabletop(standing(synthetic.THING, 0.05), width=100, height=75, pixel=0.008)
        message = self.captured(coarse, "thing").message
        for remark in ("only", "too far away", "surface.normal_radius (10.0 mm)", "without colour"):
            self.assertIn(remark, message)
        message = self.captured(tabletop(standing(synthetic.THING, 0.32)), "thing").message
        self.assertIn("cut off by the border of the image", message)

    def test_refuses_none_and_several(self):
        thing, other = standing(synthetic.THING, -0.15), standing(synthetic.ROUND, 0.15)
        for points, reason in ((tabletop(), "no object stands on the dominant plane"),
                               (tabletop(thing, other), "2 objects stand on the dominant plane"),
                               (np.full((120, 160, 3), np.nan), "no plane in the cloud"),
                               (np.zeros((0, 3)), "the cloud is empty (0 points)")):
            with self.subTest(reason):
                reply = self.capture(points, "thing")
                self.assertFalse(reply.success)
                self.assertIn(reason, reply.message)
        self.assertFalse(os.path.exists(self.file("thing")))

    def test_refuses_names_that_are_paths(self):
        for name, reason in (("", "empty"), ("../thing", "dot"), ("a/b", "slash"), ("/etc", "slash"), (".x", "dot"),
                             ("a\0b", "control"), ("a\nb", "control"), ("a" * 101, "longer than 100")):
            self.refuse("capture_view", "the object's name", reason, object=name)
        self.refuse("capture_view", "timeout", object="thing", timeout=-1)
        self.refuse("capture_view", "no cloud came on /points within 0.2 s", object="thing", timeout=0.2)

    def test_trains_and_finds_what_was_captured(self):
        for turn in (0, 40):
            self.captured(tabletop(standing(synthetic.THING, 0.05, turn=turn)), "thing")
        self.captured(tabletop(standing(synthetic.ROUND, 0)), "round")
        trained = self.succeed("train", output="captured.sks", overwrite=True)
        self.assertEqual((trained.objects, trained.views), (2, 3))
        self.assertRegex(trained.codebook, "^captured ")
        self.wait_for_status(lambda s: s.captured == [] and s.objects == ["thing", "round"], "the trained objects")
        scene = tabletop(standing(synthetic.THING, -0.12, turn=10), standing(synthetic.ROUND, 0.12, turn=5))
        found = self.succeed("detect", cloud=support.cloud_message(scene)).detections
        self.assertEqual({d.object for d in found.detections}, {"round", "thing"})
        x = {d.object: d.box_center.position.x for d in reversed(found.detections)}  # the best of each
        self.assertAlmostEqual(x["thing"], -0.12, delta=0.04)
        self.assertAlmostEqual(x["round"], 0.13, delta=0.04)

    def test_registers_views_as_they_come(self):
        """What a new view adds to the model, the same view again, and a view that is taken back."""
        # Its outline says little, and it has no colour: three views would also fit each other from opposite sides.
        turns = (0, 30, 60, 90, 120, 150)
        replies = [self.captured(tabletop(standing(synthetic.THING, 0.05, turn=turn)), "thing") for turn in turns]
        self.assertEqual([reply.registered for reply in replies[:2]], [False, False])
        last = replies[-1]
        self.assertTrue(last.registered, last.message)
        self.assertEqual(last.registered_views, 6)
        self.assertIn("6 of 6 views are registered", last.message)
        self.assertTrue(0.3 < last.coverage < 0.9, last.coverage)
        self.assertIn("degrees", last.missing)
        self.assertEqual([reply.same_as for reply in replies], [""] * 6)
        position, orientation = last.pose.position, last.pose.orientation
        self.assertGreater(position.z, 0.2)  # the camera looks down on the model
        self.assertAlmostEqual(sum(getattr(orientation, axis) ** 2 for axis in "xyzw"), 1, delta=1e-6)

        again = self.captured(tabletop(standing(synthetic.THING, 0.05, turn=30)), "thing")
        self.assertEqual(again.same_as, "thing/001.pcd")
        self.assertIn("it shows the same as view 2", again.message)
        undone = self.succeed("undo_capture", "thing")
        self.assertIn("6 views are left", undone.message)
        self.assertFalse(os.path.exists(self.file("thing/006.pcd")))
        trained = self.succeed("train")
        self.assertGreater(trained.views, 6)  # and those of the model
        self.refuse("undo_capture", "no view of 'other' was captured", object="other")

    def test_says_which_captured_views_have_no_plane(self):
        """As those of earlier releases."""
        for turn in (0, 20, 40):
            self.captured(tabletop(standing(synthetic.THING, 0.05, turn=turn)), "thing")
        with open(self.file("dataset.yaml")) as file:
            lines = re.sub(r", plane: \[[^]]*\]", "", file.read())
        with open(self.file("dataset.yaml"), "w") as file:
            file.write(lines)
        self.assertIn("object 'thing': its captured views keep frames of their own", self.succeed("train").message)
        self.captured(tabletop(standing(synthetic.THING, 0.05, turn=60)), "thing")
        self.assertIn("thing/000.pcd: the plane that it stood on is not known", self.succeed("train").message)

    def test_trains_captured_views_beside_a_data_set(self):
        self.captured(tabletop(standing(synthetic.ROUND)), "ball")
        trained = self.succeed("train", dataset="synthetic.yaml", captured=True)
        self.assertEqual((trained.objects, trained.views), (3, 3))
        self.assertEqual(self.succeed("info").objects, ["thing", "round", "ball"])
        self.assertEqual(self.succeed("train", dataset="synthetic.yaml").objects, 2)

    def test_restarts_keep_captured_views(self):
        points = tabletop(standing(synthetic.THING, 0.05))
        self.captured(points, "thing")
        self.captured(points, "tea pot")
        self.assertEqual(self.node.stop(), 0)
        self.status.clear()
        self.node.start()
        self.wait_for_status(lambda s: s.captured == ["thing", "tea pot"], "the captured views after a restart")
        self.assertEqual(self.captured(points, "thing").views, 2)
        self.assertEqual(self.succeed("train").views, 3)

    def test_removes_captured_views(self):
        points = tabletop(standing(synthetic.THING, 0.05))
        self.captured(points, "thing")
        self.captured(points, "thing")
        self.captured(points, "other")
        self.succeed("train")
        removed = self.succeed("remove_object", object="thing")
        self.assertEqual(removed.views, 0)
        self.assertGreater(removed.words, 0)
        self.assertIn("2 captured views are kept", removed.message)
        self.assertEqual(self.succeed("info").objects, ["other"])
        self.refuse("remove_object", "not in the codebook", "delete_views", object="thing")
        self.assertEqual(self.succeed("train").objects, 2)
        removed = self.succeed("remove_object", object="thing", delete_views=True)
        self.assertEqual(removed.views, 2)
        self.assertGreater(removed.words, 0)
        self.assertEqual(self.succeed("info").objects, ["other"])
        self.assertFalse(os.path.exists(self.file("thing")))
        self.assertEqual(self.succeed("train").objects, 1)

    def test_keeps_a_damaged_data_set_as_it_is(self):
        self.captured(tabletop(standing(synthetic.THING, 0.05)), "thing")
        with open(self.file("dataset.yaml")) as file:
            whole = file.read()
        try:
            with open(self.file("dataset.yaml"), "w") as file:
                file.write("name: [")
            self.refuse("capture_view", "dataset.yaml:", object="thing")
            self.refuse("train", "dataset.yaml:")
            self.refuse("remove_object", "dataset.yaml:", object="thing")
            self.assertEqual(self.node.stop(), 0)
            self.node.start()
            with open(self.file("dataset.yaml")) as file:
                self.assertEqual(file.read(), "name: [")
        finally:
            with open(self.file("dataset.yaml"), "w") as file:
                file.write(whole)

    def test_takes_unorganized_clouds(self):
        points = tabletop(standing(synthetic.THING, 0.05)).reshape(-1, 3)
        points = points[np.isfinite(points).all(1)]
        reply = self.captured(points, "thing", services_support.colors_of(points))
        self.assertGreater(reply.points, 1000)
        with open(reply.view, "rb") as file:
            self.assertIn(b"HEIGHT 1\n", file.read(400))


if __name__ == "__main__":
    rospy.init_node("services_capture_test")
    rostest.rosrun("sks_detector", "services_capture", CaptureServicesTest)
