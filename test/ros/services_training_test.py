#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Training by service: what it makes, what it refuses, and that frames go on meanwhile."""
import os
import shutil
import threading
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Log

import services_support
import support
import synthetic
from sks_detector.msg import DetectionArray, Status

THING = {"object": "thing", "cloud": "thing.pcd", "kind": "view"}


class Call(threading.Thread):
    """A service call in the background."""

    def __init__(self, node, service, **fields):
        super().__init__()
        self._call = lambda: node.call(service, **fields)
        self.reply = None
        self.start()

    def run(self):
        try:
            self.reply = self._call()
        except rospy.ServiceException:
            pass  # the node is gone

    def result(self):
        self.join(4 * support.PATIENCE)  # trainings take what others leave of the processor
        assert self.reply is not None, "the service did not reply"
        return self.reply


class TrainingServicesTest(services_support.ServicesTest):
    def setUp(self):
        self.old = self.succeed("load_codebook", "synthetic.sks").codebook

    def tearDown(self):
        super().tearDown()
        self.node.call("cancel_training")
        self.wait_for_status(lambda s: s.state != Status.TRAINING, "the end of the training")

    def start_slow_training(self, **fields):
        self.write_slow_dataset()
        call = Call(self.node, "train", dataset="slow.yaml", settings=["threads=1"], **fields)
        self.wait_for_status(lambda s: s.state == Status.TRAINING and s.progress_fraction > 0, "a training's progress")
        return call

    def expect_old_codebook(self):
        self.assertEqual(self.succeed("info").codebook, self.old)
        found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual({d.object for d in found.detections}, {"round", "thing"})
        self.wait_for_status(lambda s: s.state != Status.TRAINING and not s.progress, "the end of the training")

    def test_trains_saves_and_swaps_in(self):
        trained = self.succeed("train", dataset="synthetic.yaml", name="toys", output="new/toys.sks")
        self.assertRegex(trained.codebook, r"^toys \([0-9a-f]{8}\)$")
        self.assertEqual((trained.objects, trained.views), (2, 2))
        self.assertGreater(trained.words, 50)
        self.assertGreater(trained.seconds, 0)
        info = self.succeed("info")
        self.assertEqual(info.codebook, trained.codebook)
        self.assertEqual(info.codebook_file, os.path.join(self.node.codebooks, "new/toys.sks"))
        found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual({d.object for d in found.detections}, {"round", "thing"})
        self.assertEqual(found.codebook, trained.codebook)
        self.assertEqual(self.succeed("load_codebook", "new/toys.sks").codebook, trained.codebook)

    def test_keeps_existing_files_unless_told(self):
        with open(os.path.join(self.node.codebooks, "synthetic.sks"), "rb") as file:
            before = file.read()
        self.refuse("train", "holds the codebook synthetic (", "overwrite", dataset="synthetic.yaml",
                    output="synthetic.sks")
        with open(os.path.join(self.node.codebooks, "synthetic.sks"), "rb") as file:
            self.assertEqual(file.read(), before)
        self.succeed("train", dataset="synthetic.yaml", output="copy.sks")
        self.succeed("train", dataset="synthetic.yaml", output="copy.sks", overwrite=True)

    def test_takes_settings_of_its_own(self):
        self.succeed("train", dataset="synthetic.yaml", settings=["descriptor.radius=0.06", "keypoints.grid_size=0.03"])
        settings = self.succeed("info").settings
        self.assertIn("radius: 0.06", settings)
        self.assertIn("grid_size: 0.02", settings)  # a scene's is not bound to the codebook
        self.succeed("train", dataset="synthetic.yaml")
        self.assertIn("radius: 0.05", self.succeed("info").settings)

    def test_refuses_what_cannot_be_trained_and_keeps_the_old_codebook(self):
        self.write_dataset("missing_cloud.yaml", [{"object": "thing", "cloud": "gone.pcd", "kind": "view"}])
        self.write_dataset("none.yaml", [], tests=[{"object": "thing", "cloud": "thing.pcd"}])
        self.write_dataset("damaged.yaml", [THING, {"object": "thing", "cloud": "damaged.pcd", "kind": "view"}])
        with open(os.path.join(self.node.datasets, "damaged.pcd"), "w") as file:
            file.write("VERSION 0.7\n")
        for fields, reasons in (
                ({"dataset": "nothing.yaml"}, ["nothing.yaml", "No such file"]),
                ({"dataset": "missing_cloud.yaml"}, ["missing_cloud.yaml:", "gone.pcd"]),
                ({"dataset": "thing.pcd"}, ["thing.pcd"]),
                ({"dataset": "none.yaml"}, ["no training clouds"]),
                ({"dataset": "damaged.yaml"}, ["damaged.pcd"]),
                ({}, ["no view was captured yet"]),
                ({"dataset": "synthetic.yaml", "settings": ["descriptor.radus=1"]}, ["did you mean", "descriptor.radius"]),
                ({"dataset": "synthetic.yaml", "settings": ["descriptor.radius=9"]}, ["descriptor.radius", "9"]),
                ({"dataset": "synthetic.yaml", "settings": ["descriptor.radius=0.005"]}, ["surface.normal_radius"]),
                ({"dataset": "synthetic.yaml", "settings": ["shot"]}, ["key=value"])):
            with self.subTest(fields):
                self.refuse("train", *reasons, **fields)
                self.expect_old_codebook()

    def test_captured_views_that_are_gone_or_damaged_are_left_out_and_named(self):
        folder = os.path.join(self.node.datasets, "captured")
        for name in ("kept", "gone", "damaged"):
            os.makedirs(os.path.join(folder, name))
            shutil.copy(os.path.join(self.node.datasets, "thing.pcd"), os.path.join(folder, name, "000.pcd"))
        self.write_dataset("captured/dataset.yaml", [
            {"object": name, "cloud": name + "/000.pcd", "kind": "view"} for name in ("gone", "kept", "damaged")])
        os.remove(os.path.join(folder, "gone/000.pcd"))
        with open(os.path.join(folder, "damaged/000.pcd"), "w") as file:
            file.write("VERSION 0.7\n")
        log = support.Recorder("/rosout", Log)
        support.wait_for(lambda: log.connections() > 0, "the log")
        try:
            trained = self.succeed("train", captured=True)
            self.assertEqual((trained.objects, trained.views), (1, 1))
            for name in ("gone/000.pcd", "damaged/000.pcd"):
                self.assertIn(name, trained.message)
                support.wait_for(lambda: support.log_messages(log, name), "the warning about " + name)
            self.assertEqual(self.succeed("info").objects, ["kept"])
            self.assertEqual(self.succeed("remove_object", object="gone", delete_views=True).views, 1)
            self.assertNotIn("gone/000.pcd", self.succeed("train", captured=True).message)
            os.remove(os.path.join(folder, "kept/000.pcd"))
            self.refuse("train", "no captured view can be used", "kept/000.pcd", captured=True)
        finally:
            log.close()
            shutil.rmtree(folder)

    def test_refuses_data_sets_that_reach_out(self):
        outside = os.path.join(self.folder, "secret.pcd")
        os.link(os.path.join(self.node.datasets, "thing.pcd"), outside)
        self.write_dataset("reaching.yaml", [{"object": "thing", "cloud": "../secret.pcd", "kind": "view"}])
        self.refuse("train", "reaching.yaml", "'thing'", outside, "outside", self.node.datasets,
                    dataset="reaching.yaml")
        self.refuse("train", "outside", self.node.datasets, dataset="../datasets2/x.yaml")
        self.refuse("train", "outside", dataset="/etc/passwd")
        # out and in again is inside
        self.write_dataset("returning.yaml", [dict(THING, cloud="../datasets/thing.pcd")])
        self.succeed("train", dataset="returning.yaml")

    def test_refuses_a_second_training_and_other_changes(self):
        call = self.start_slow_training()
        self.refuse("train", "a training runs already", "~cancel_training", dataset="synthetic.yaml")
        self.refuse("load_codebook", "a training runs", path="synthetic.sks")
        self.refuse("remove_object", "a training runs", object="thing")
        self.assertEqual(self.succeed("info").codebook, self.old)
        self.succeed("save_codebook", "meanwhile.sks", True)
        self.succeed("cancel_training")
        self.assertFalse(call.result().success)
        self.succeed("train", dataset="synthetic.yaml")

    def test_can_be_cancelled(self):
        self.refuse("cancel_training", "no training runs")
        call = self.start_slow_training(output="cancelled.sks")
        self.succeed("cancel_training")
        reply = call.result()
        self.assertFalse(reply.success)
        self.assertRegex(reply.message, r"training was cancelled after \d+ of 1000")
        self.assertNotIn("cancelled.sks", os.listdir(self.node.codebooks))
        self.expect_old_codebook()

    def test_detects_with_the_old_codebook_until_the_new_one_is_whole(self):
        listener = support.Recorder("/detector/detections", DetectionArray)
        self.addCleanup(listener.close)
        self.source.wait_for_subscriber()
        self.write_slow_dataset(views=400)
        scene = synthetic.scene()
        call = Call(self.node, "train", dataset="slow.yaml", settings=["threads=1"])
        self.wait_for_status(lambda s: s.state == Status.TRAINING and s.progress_fraction > 0, "a training's progress")
        seen = []
        while call.is_alive():
            answer = listener.wait_for_stamp(self.source.send(support.cloud_message(scene)))
            seen.append(answer.codebook)
            expected = {"round", "thing"} if answer.codebook == self.old else {"thing"}
            self.assertEqual({d.object for d in answer.detections}, expected)
        new, during = call.result().codebook, seen.count(self.old)
        self.assertGreater(during, 2)
        answer = listener.wait_for_stamp(self.source.send(support.cloud_message(scene)))
        self.assertEqual(answer.codebook, new)
        self.assertEqual(seen, [self.old] * during + [new] * (len(seen) - during), "one swap")

    def test_trains_meshes(self):
        self.write_dataset("meshes.yaml", [{"object": "mug", "cloud": "builtin:mug", "kind": "mesh"}])
        reply = self.node.call("train", dataset="meshes.yaml")
        self.assertTrue(reply.success, reply.message)
        self.assertEqual(self.succeed("info").objects, ["mug"])
        self.assertEqual(reply.views, 42)

    def write_box(self, materials):
        """An OBJ file of a box of 0.14 m x 0.09 m x 0.06 m that names its materials."""
        with open(os.path.join(self.node.datasets, "box.obj"), "w") as file:
            file.write("mtllib %s\nusemtl m\n" % materials)
            for i in range(8):
                file.write("v %g %g %g\n" % (0.14 * (i & 1), 0.09 * (i >> 1 & 1), 0.06 * (i >> 2)))
            file.write("f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")
        self.write_dataset("box.yaml", [{"object": "box", "cloud": "box.obj", "kind": "mesh"}])

    def test_materials_of_meshes_lie_in_the_folder_too(self):
        outside, inside = (os.path.join(folder, "box.mtl") for folder in (self.folder, self.node.datasets))
        for path in (outside, inside):
            with open(path, "w") as file:
                file.write("newmtl m\nKd 1 0 0\n")
        self.write_box("box.mtl")
        colored = {"dataset": "box.yaml", "settings": ["descriptor.type=cshot"]}
        self.succeed("train", **colored)
        os.remove(inside)
        for name in ("../box.mtl", outside):
            self.write_box(name)
            reply = self.node.call("train", **colored)
            self.assertFalse(reply.success)
            self.assertIn("the cloud has none", reply.message)
            self.succeed("train", dataset="box.yaml")

    def test_pipes_are_not_waited_for(self):
        os.mkfifo(os.path.join(self.node.datasets, "pipe.yaml"))
        self.refuse("train", "no regular file", dataset="pipe.yaml")
        self.write_dataset("pipe_in_it.yaml", [dict(THING, cloud="pipe.yaml")])
        self.refuse("train", "no regular file", dataset="pipe_in_it.yaml")
        self.write_box("pipe.yaml")
        self.succeed("train", dataset="box.yaml")
        self.assertEqual(self.succeed("info").descriptor, "shot")

    def test_ends_quickly_while_it_trains(self):
        call = self.start_slow_training(output="ended.sks")
        self.assertEqual(self.node.stop(), 0)
        call.join(support.PATIENCE)
        self.assertTrue(call.reply is None or not call.reply.success)
        self.assertNotIn("ended.sks", os.listdir(self.node.codebooks))
        self.status.clear()
        self.node.start()


if __name__ == "__main__":
    rospy.init_node("services_training_test")
    rostest.rosrun("sks_detector", "services_training", TrainingServicesTest)
