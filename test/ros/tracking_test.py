#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""~tracking: objects keep their identity from cloud to cloud, and what ends that."""
import unittest

import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

import support
import synthetic
from sks_detector.msg import DetectionArray
from sks_detector.srv import LoadCodebook

BOTH = ["round", "thing"]


class TrackingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.detections = support.Recorder("/detector/detections", DetectionArray)
        cls.transforms = support.Recorder("/tf", TFMessage)
        cls.diagnostics = support.Recorder("/diagnostics", DiagnosticArray)
        cls.source = support.CloudSource("/points")
        cls.broadcaster = tf2_ros.StaticTransformBroadcaster()
        cls.client = dynamic_reconfigure.client.Client("/detector", timeout=support.PATIENCE)

    def answer(self, names=("thing", "round")):
        """Of a cloud that is stamped now; no two in less than a thirtieth of a second."""
        rospy.sleep(0.04)
        return self.detections.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene(names=names))))

    def followed(self, names=("thing", "round"), after=0):
        """The answer in which all of these are followed, by objects with numbers larger than this."""
        def found():
            answer = self.answer(names)
            ids = [d.id for d in answer.detections]
            return answer if len(ids) == len(names) and min(ids) > after else None
        return support.wait_for(found, "the objects to be followed")

    def ids(self, answer):
        return {d.object: d.id for d in answer.detections}

    def tracking_values(self):
        def found():
            for message in reversed(self.diagnostics.messages):
                for status in message.status:
                    if status.name.endswith("Tracking"):
                        return {value.key: value.value for value in status.values}
            return None
        return support.wait_for(found, "diagnostics of the tracking")

    def test_objects_keep_their_numbers_and_places(self):
        first = self.followed()
        ids = self.ids(first)
        self.assertEqual(len(set(ids.values())), 2)
        for _ in range(5):
            answer = self.answer()
            self.assertEqual(self.ids(answer), ids)
            for detection in answer.detections:
                self.assertTrue(detection.tracked)
                self.assertGreaterEqual(detection.score, 0.5)
                np.testing.assert_allclose(support.position_of(detection.box_center),
                                           synthetic.position(detection.object), atol=0.01)
        frames = {t.child_frame_id for m in self.transforms.messages for t in m.transforms}
        self.assertTrue(set(BOTH) <= frames, frames)

    def test_what_is_gone_is_not_told_and_counted_as_lost(self):
        ids = self.ids(self.followed())
        self.diagnostics.clear()
        before = int(self.tracking_values()["lost"])
        answer = self.answer(("thing",))
        self.assertEqual(self.ids(answer), {"thing": ids["thing"]})

        def lost():
            self.answer(("thing",))
            self.diagnostics.clear()
            return int(self.tracking_values()["lost"]) > before
        support.wait_for(lost, "the loss in the diagnostics")
        back = self.ids(self.followed())
        self.assertEqual(back["thing"], ids["thing"])
        self.assertGreater(back["round"], max(ids.values()))

    def test_another_codebook_and_switching_it_off_begin_anew(self):
        ids = self.ids(self.followed())
        load = rospy.ServiceProxy("/detector/load_codebook", LoadCodebook)
        self.assertTrue(load(support.CODEBOOK).success)
        after = self.ids(self.followed(after=max(ids.values())))
        self.client.update_configuration({"tracking": False})
        for _ in range(3):
            for detection in self.answer().detections:
                self.assertEqual((detection.id, detection.tracked), (0, False))
        self.assertEqual(sorted(d.object for d in self.answer().detections), BOTH)
        self.client.update_configuration({"tracking": True})
        self.assertGreater(min(self.ids(self.followed()).values()), max(after.values()))

    def test_objects_may_have_thresholds_of_their_own(self):
        self.followed()
        self.addCleanup(self.client.update_configuration, {"detection.thresholds": ""})
        self.client.update_configuration({"detection.thresholds": "thing=1"})  # no score is
        ids = self.ids(support.wait_for(lambda: self.followed(("round",)), "the other object"))
        for _ in range(5):
            self.assertEqual(self.ids(self.answer()), ids)

    def test_a_fixed_frame_that_comes_and_goes_does_no_harm(self):
        ids = self.ids(self.followed())
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "odom", "camera"
        transform.header.stamp = rospy.Time.now()
        transform.transform.translation.x, transform.transform.rotation.w = 2, 1
        self.broadcaster.sendTransform(transform)
        for _ in range(5):
            answer = self.answer()
            self.assertEqual(self.ids(answer), ids)
            self.assertEqual(answer.header.frame_id, "camera")
            for detection in answer.detections:
                np.testing.assert_allclose(support.position_of(detection.box_center),
                                           synthetic.position(detection.object), atol=0.01)

    def test_unusable_clouds_are_answered_with_an_empty_array(self):
        self.followed()
        broken = support.cloud_message(np.full((10, 10, 3), np.nan))
        self.assertEqual(self.detections.wait_for_stamp(self.source.send(broken)).detections, [])
        self.followed()


if __name__ == "__main__":
    rospy.init_node("tracking_test")
    rostest.rosrun("sks_detector", "tracking_test", TrackingTest)
