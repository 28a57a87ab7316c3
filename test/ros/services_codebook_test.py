#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Services that load, save, change and tell about codebooks, switch detection, and detect once."""
import os
import shutil
import subprocess
import threading

import numpy as np
import rospy
import rostest
import yaml

import services_support
import support
import synthetic
from sks_detector.msg import DetectionArray, Status


class CodebookServicesTest(services_support.ServicesTest):
    def setUp(self):
        self.succeed("load_codebook", "synthetic.sks")

    def path(self, name):
        return os.path.join(self.node.codebooks, name)

    def test_loads_and_tells_what_is_loaded(self):
        loaded = self.succeed("load_codebook", self.path("synthetic.sks"))
        self.assertRegex(loaded.codebook, r"^synthetic \([0-9a-f]{8}\)$")
        self.assertEqual(loaded.objects, ["thing", "round"])
        self.assertEqual(loaded.views, 2)
        self.assertGreater(loaded.words, 50)
        info = self.succeed("info")
        self.assertEqual(info.codebook, loaded.codebook)
        self.assertEqual(info.codebook_file, self.path("synthetic.sks"))
        self.assertEqual(info.descriptor, "shot")
        self.assertEqual(info.objects, ["thing", "round"])
        self.assertEqual(list(info.views), [1, 1])
        self.assertEqual(sum(info.words), loaded.words)
        self.assertEqual(yaml.safe_load(info.settings)["descriptor"]["type"], "shot")
        status = self.wait_for_status(lambda s: s.codebook == loaded.codebook, "the codebook in the status")
        self.assertEqual(status.state, Status.READY)

    def test_refuses_to_load_what_is_no_codebook_and_keeps_the_old_one(self):
        before = self.succeed("info")
        with open(self.path("foreign.sks"), "w") as file:
            file.write("this is no codebook")
        with open(self.path("synthetic.sks"), "rb") as whole, open(self.path("cut.sks"), "wb") as cut:
            cut.write(whole.read()[:-100])
        self.refuse("load_codebook", "foreign.sks", path="foreign.sks")
        self.refuse("load_codebook", "cut.sks", path="cut.sks")
        self.refuse("load_codebook", "missing.sks", "No such file", path="missing.sks")
        self.assertEqual(self.succeed("info"), before)

    def test_refuses_paths_that_lead_out(self):
        outside = os.path.join(self.folder, "outside")
        os.makedirs(outside, exist_ok=True)
        shutil.copy(support.CODEBOOK, outside)
        os.symlink(outside, self.path("link"))
        os.symlink(os.path.join(outside, "new.sks"), self.path("dangling.sks"))
        for path in ("../outside/synthetic.sks", outside + "/synthetic.sks", "link/synthetic.sks", "/etc/passwd",
                     "x/../../outside/synthetic.sks"):
            for service in ("load_codebook", "save_codebook"):
                self.refuse(service, "'%s' is refused" % path, "outside", self.node.codebooks, path=path)
            self.refuse("train", "'%s' is refused" % path, self.node.codebooks, dataset="synthetic.yaml", output=path)
        for path, reason in (("", "empty"), (".", "folder"), ("dangling.sks", "No such file"), ("a\0.sks", "null"),
                             ("~/a.sks", "not expanded"), ("a" * 5000, "too long"), ("a.yaml", "end with .sks")):
            self.refuse("save_codebook", reason, path=path)
        self.assertEqual(os.listdir(outside), ["synthetic.sks"])

    def test_saves_and_keeps_other_codebooks(self):
        saved = self.succeed("save_codebook", "new/folder/copy.sks", False)
        self.assertEqual(saved.path, self.path("new/folder/copy.sks"))
        self.assertEqual(self.succeed("info").codebook_file, saved.path)
        self.succeed("save_codebook", "new/folder/copy.sks", False)  # it is the same

        self.succeed("remove_object", object="round")
        self.refuse("save_codebook", "holds the codebook synthetic (", "set overwrite", path="new/folder/copy.sks")
        self.succeed("save_codebook", "new/folder/copy.sks", True)
        self.assertEqual(self.succeed("load_codebook", saved.path).objects, ["thing"])
        with open(self.path("precious.sks"), "w") as file:
            file.write("something else")
        self.refuse("save_codebook", "is not a codebook", path="precious.sks")

    def test_of_two_nodes_that_save_one_name_one_is_refused(self):
        rospy.set_param("/second/codebook_directory", self.node.codebooks)
        second = subprocess.Popen(["rosrun", "sks_detector", "detector_node", "__name:=second"])
        self.addCleanup(lambda: (second.terminate(), second.wait()))
        call = {name: rospy.ServiceProxy("/second/" + name, services_support.TYPES[name])
                for name in ("load_codebook", "remove_object", "save_codebook")}
        for service in call.values():
            service.wait_for_service(support.PATIENCE)
        self.assertTrue(call["load_codebook"]("synthetic.sks").success)
        self.assertTrue(call["remove_object"](object="round").success)  # so that the two codebooks differ
        for i in range(20):
            name, replies = "race%d.sks" % i, [None, None]
            savers = [lambda: replies.__setitem__(0, self.node.call("save_codebook", name, False)),
                      lambda: replies.__setitem__(1, call["save_codebook"](name, False))]
            threads = [threading.Thread(target=saver) for saver in savers]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(sorted(reply.success for reply in replies), [False, True], replies)
            first_won = replies[0].success
            self.assertIn("exists already and holds the codebook synthetic (", replies[1 if first_won else 0].message)
            self.assertEqual(self.succeed("load_codebook", name).objects, ["thing", "round"] if first_won else ["thing"])
            self.succeed("load_codebook", "synthetic.sks")
        self.assertFalse([name for name in os.listdir(self.node.codebooks) if ".part" in name])

    def test_removes_objects(self):
        before = self.succeed("info")
        self.refuse("remove_object", "no object 'thin'", "did you mean 'thing'", object="thin")
        removed = self.succeed("remove_object", object="thing")
        self.assertEqual(removed.words, before.words[0])
        after = self.succeed("info")
        self.assertEqual(after.objects, ["round"])
        self.assertEqual(after.words, before.words[1:])
        self.assertNotEqual(after.codebook, before.codebook)
        self.assertEqual(after.codebook_file, "")
        found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual({d.object for d in found.detections}, {"round"})
        self.assertEqual(found.codebook, after.codebook)

        self.succeed("remove_object", object="round")
        self.assertIn("there is no codebook", self.succeed("info").message)
        self.wait_for_status(lambda s: s.state == Status.NO_CODEBOOK, "no codebook in the status")
        self.refuse("save_codebook", "no codebook to save", path="none.sks")
        self.refuse("detect", "there is no codebook", cloud=support.cloud_message(synthetic.scene()))
        self.refuse("remove_object", "there are none", object="round")

    def test_detects_in_the_cloud_of_a_request_even_when_disabled(self):
        self.succeed("enable", False)
        self.wait_for_status(lambda s: s.state == Status.DISABLED, "the disabled state")
        cloud = support.cloud_message(synthetic.scene(), stamp=rospy.Time(12, 34))
        found = self.succeed("detect", cloud=cloud).detections
        self.assertEqual(found.header.stamp, cloud.header.stamp)
        self.assertEqual(found.header.frame_id, "camera")
        self.assertEqual(sorted(d.object for d in found.detections), ["round", "thing"])
        for detection in found.detections:
            np.testing.assert_allclose(support.position_of(detection.box_center), synthetic.position(detection.object),
                                       atol=0.01)
        self.assertGreater(found.processing_time, 0)
        self.succeed("enable", True)
        self.wait_for_status(lambda s: s.state == Status.READY, "the enabled state")

    def test_detects_in_the_next_cloud_while_nobody_listens(self):
        self.succeed("enable", False)
        support.wait_for(lambda: self.source.publisher.get_num_connections() == 0, "the end of the subscription")
        replies = []
        call = threading.Thread(target=lambda: replies.append(self.node.call("detect", timeout=30)))
        call.start()
        stamp = self.source.send(support.cloud_message(synthetic.scene()))
        call.join()
        self.assertTrue(replies[0].success, replies[0].message)
        self.assertEqual(replies[0].detections.header.stamp, stamp)
        self.assertEqual({d.object for d in replies[0].detections.detections}, {"round", "thing"})
        self.succeed("enable", True)

    def test_refuses_to_detect_without_a_usable_cloud(self):
        self.refuse("detect", "no cloud came on /points within 0.2 s", timeout=0.2)
        for timeout in (-1, float("nan"), float("inf"), 1e9):
            self.refuse("detect", "timeout", "0 to 3600 s", timeout=timeout)
        self.refuse("detect", "19200 are NaN", cloud=support.cloud_message(np.full((120, 160, 3), np.nan)))
        broken = support.cloud_message(synthetic.scene())
        broken.data = broken.data[:1000]
        self.refuse("detect", "holds 1000 bytes", cloud=broken)

    def test_disabled_nodes_let_clouds_go_by(self):
        listener = support.Recorder("/detector/detections", DetectionArray)
        self.addCleanup(listener.close)
        self.source.wait_for_subscriber()
        self.succeed("enable", False)
        support.wait_for(lambda: self.source.publisher.get_num_connections() == 0, "the end of the subscription")
        self.succeed("enable", True)
        listener.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene())))


if __name__ == "__main__":
    rospy.init_node("services_codebook_test")
    rostest.rosrun("sks_detector", "services_codebook", CodebookServicesTest)
