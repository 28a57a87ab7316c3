#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Transforms that are missing, late, in a loop, or no transforms: the cloud is answered, and so are those after it."""
import unittest

import numpy as np
import rospy
import rostest
import tf2_msgs.msg
from geometry_msgs.msg import TransformStamped

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


def transform(parent, child, stamp, x=0.0, w=1.0):
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id, message.header.stamp = parent, child, stamp
    message.transform.translation.x, message.transform.rotation.w = x, w
    return message


class FaultyTransformsTest(unittest.TestCase):
    def setUp(self):
        # new ones: rospy keeps connections to what has gone
        self.transforms = rospy.Publisher("/tf", tf2_msgs.msg.TFMessage, queue_size=100)
        self.source = support.CloudSource("/points")
        self.detections = support.Recorder("/detector/detections", DetectionArray)
        self.status = support.Recorder("/detector/status", Status)

    def tearDown(self):
        self.detections.close()
        self.status.close()
        self.source.publisher.unregister()
        self.transforms.unregister()

    def node(self, timeout, target):
        return support.Node(parameters={"codebook": support.CODEBOOK, "tf_timeout": timeout, "target_frame": target})

    def connect(self):
        self.source.wait_for_subscriber()
        support.wait_for(lambda: self.transforms.get_num_connections() > 0, "a listener of /tf")

    def tell(self, *transforms):
        self.transforms.publish(tf2_msgs.msg.TFMessage(list(transforms)))

    def send(self):
        return self.source.send(support.cloud_message(synthetic.scene()))

    def expect(self, stamp, target, x=0.0):
        answer = self.detections.wait_for_stamp(stamp)
        self.assertEqual((answer.header.frame_id, len(answer.detections)), (target, 2))
        for detection in answer.detections:
            np.testing.assert_allclose(support.position_of(detection.box_center),
                                       synthetic.position(detection.object) + [x, 0, 0], atol=0.01)

    def refuse(self, stamp, target):
        answer = self.detections.wait_for_stamp(stamp)
        self.assertEqual((answer.header.frame_id, answer.detections), (target, []))
        self.status.wait_for(lambda s: "no transform from 'camera' to '%s'" % target in s.last_error, "the error")

    def test_a_late_transform_is_waited_for(self):
        with self.node(support.PATIENCE, "late"):
            self.connect()
            stamp = self.send()
            rospy.sleep(1)  # what is late
            self.assertNotIn(stamp, [m.header.stamp for m in self.detections.messages])
            self.tell(transform("late", "camera", stamp - rospy.Duration(1), 1), transform("late", "camera", stamp, 2))
            self.expect(stamp, "late", 2)

    def tell_around_now(self, *links):
        """Transforms of a second ago and of the next seconds: tf2 keeps ten, and interpolates."""
        for offset in (-1, 4):
            self.tell(*(transform(parent, child, rospy.Time.now() + rospy.Duration(offset), *values)
                        for parent, child, *values in links))

    def expect_soon(self, target, x, *links):
        """Once the transforms have arrived clouds are answered with them."""
        def found():
            self.tell_around_now(*links)
            stamp = self.send()
            return self.detections.wait_for_stamp(stamp).detections and stamp
        self.expect(support.wait_for(found, "detections in " + target), target, x)

    def refuse_soon(self, target, reason, *links):
        def refused():
            self.tell_around_now(*links)
            self.assertEqual(self.detections.wait_for_stamp(self.send()).detections, [])
            return any(reason in status.last_error for status in self.status.messages)
        support.wait_for(refused, reason)

    def test_a_transform_that_comes_too_late_is_not(self):
        with self.node(0.2, "slow"):
            self.connect()
            for age in (4, 3):
                self.tell(transform("slow", "camera", rospy.Time.now() - rospy.Duration(age), 1))
            self.refuse(self.send(), "slow")
            self.expect_soon("slow", 1, ("slow", "camera", 1))

    def test_a_loop_of_transforms_is_refused(self):
        with self.node(0.2, "first") as node:
            self.connect()
            self.refuse_soon("first", "loop", ("other", "first"), ("second", "camera"), ("third", "second"),
                             ("camera", "third"))
            self.assertTrue(node.alive())

    def test_transforms_that_are_none_do_no_harm(self):
        with self.node(0.2, "odd") as node:
            self.connect()
            for _ in range(3):  # tf2 throws where it looks ten seconds beyond
                self.tell(transform("end", "time", rospy.Time(2**32 - 1, 999999999)))
            node.wait_for_output("transform from 'time' to 'end' of /faults_transforms is ignored")
            self.expect_soon("odd", 3, ("odd", "camera", float("nan")), ("odd", "camera", 1, 0.0), ("odd", ""),
                             ("", "camera"), ("camera", "camera"), ("/odd", "/camera", 3))
            self.assertTrue(node.alive())


if __name__ == "__main__":
    rospy.init_node("faults_transforms_test")
    rostest.rosrun("sks_detector", "faults_transforms", FaultyTransformsTest)
