#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""~target_frame, ~sensor_frame and ~publish_tf."""
import unittest

import dynamic_reconfigure.client
import numpy as np
import rosgraph
import rospy
import rostest
import tf2_msgs.msg
import tf2_ros
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import PointCloud2

import support
import synthetic
from sks_detector.msg import DetectionArray, Status

# The robot's base looks along x, the camera along z.
T_BASE_CAMERA = np.array([[0, 0, 1, 0.1], [-1, 0, 0, 0.2], [0, -1, 0, 0.9], [0, 0, 0, 1.0]])


def camera_in_base():
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = "base_link", "camera"
    transform.transform.translation.x, transform.transform.translation.y, transform.transform.translation.z = (
        T_BASE_CAMERA[:3, 3])
    rotation = transform.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = -0.5, 0.5, -0.5, 0.5
    return transform


class FramesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.broadcaster = tf2_ros.StaticTransformBroadcaster()
        cls.broadcaster.sendTransform(camera_in_base())
        cls.source = support.CloudSource("/points")

    def setUp(self):
        self.detections = support.Recorder("/detector/detections", DetectionArray)

    def tearDown(self):
        self.detections.close()

    def node(self, **parameters):
        return support.Node(parameters=dict({"codebook": support.CODEBOOK, "tf_timeout": 30.0}, **parameters))

    def answer(self, points, frame="camera"):
        return support.answer(self.source, support.cloud_message(points, frame), self.detections)

    def expect_in_base(self, answer):
        self.assertEqual(answer.header.frame_id, "base_link")
        self.assertEqual(len(answer.detections), 2)
        for detection in answer.detections:
            position = synthetic.apply(T_BASE_CAMERA, synthetic.position(detection.object)[None])[0]
            np.testing.assert_allclose(support.position_of(detection.box_center), position, atol=0.01)
            T = T_BASE_CAMERA @ synthetic.model_pose(detection.object)
            np.testing.assert_allclose(support.matrix_of(detection.pose.pose), T, atol=0.08)

    def test_answers_in_the_target_frame(self):
        for frame in ("base_link", "/base_link"):
            with self.node(target_frame=frame):
                self.expect_in_base(self.answer(synthetic.scene()))

    def test_shows_keypoints_and_votes_in_the_target_frame(self):
        clouds = [support.Recorder("/detector/" + name, PointCloud2) for name in ("keypoints", "votes")]
        points = synthetic.scene()
        with self.node(target_frame="base_link"):
            support.wait_for(lambda: all(c.connections() for c in clouds), "connections")
            stamp = self.answer(points).header.stamp
            corners = synthetic.apply(T_BASE_CAMERA, points[np.isfinite(points).all(-1)])
            for cloud in clouds:
                message = cloud.wait_for_stamp(stamp)
                self.assertEqual(message.header.frame_id, "base_link")
                shown = support.points_of(message)
                self.assertGreater(len(shown), 50)
                inside = (shown > corners.min(0) - 0.1) & (shown < corners.max(0) + 0.1)
                self.assertGreater(inside.all(1).mean(), 0.9)
                cloud.close()

    def test_answers_empty_and_says_why_where_the_transform_is_missing(self):
        with self.node(target_frame="nowhere", tf_timeout=0.1) as node:
            status = support.Recorder("/detector/status", Status)
            answer = self.answer(synthetic.scene())
            self.assertEqual((answer.header.frame_id, answer.detections), ("nowhere", []))
            error = status.wait_for(lambda s: "no transform from 'camera' to 'nowhere'" in s.last_error).last_error
            self.assertEqual(error.count("does not exist"), 1, error)  # however often tf2 was asked while waiting
            for _ in range(3):
                self.answer(synthetic.scene())
                rospy.sleep(0.6)
            self.assertEqual(node.output().count("no transform from"), 1, "the same is said twice a minute")
            self.assertTrue(node.alive())
            status.close()

    def test_takes_the_place_of_the_camera_from_the_sensor_frame(self):
        points = synthetic.scene()
        in_base = synthetic.apply(T_BASE_CAMERA, points.reshape(-1, 3)).reshape(points.shape)
        with self.node(sensor_frame="camera"):
            self.expect_in_base(self.answer(in_base, "base_link"))

    def test_broadcasts_detections_even_if_nobody_listens(self):
        self.detections.close()
        transforms = support.Recorder("/tf", tf2_msgs.msg.TFMessage)
        twins = np.concatenate([synthetic.scene(("thing",), wall=False, shift=(dx, 0, 0)) for dx in (0, 0.19)])
        with self.node(publish_tf=True):
            cloud = support.cloud_message(twins.reshape(-1, 3))
            message = support.wait_for(lambda: self.source.send(cloud) and next(
                (m for m in transforms.messages if m.transforms[0].header.stamp == cloud.header.stamp), None), "/tf")
            self.assertEqual({t.child_frame_id for t in message.transforms}, {"thing", "thing_2"})
            found = sorted(t.transform.translation.x for t in message.transforms)
            expected = sorted(synthetic.model_pose("thing", (dx, 0, 0))[0, 3] for dx in (0, 0.19))
            np.testing.assert_allclose(found, expected, atol=0.05)
        transforms.close()

    def transforms_of(self, nodes, frame="camera"):
        """(parent, child) of what the nodes broadcast of one cloud with both objects."""
        transforms = support.Recorder("/tf", tf2_msgs.msg.TFMessage)
        self.detections.clear()
        sent = support.cloud_message(synthetic.scene(), frame)
        support.wait_for(lambda: self.source.publisher.get_num_connections() == nodes, "the nodes")

        def broadcast():
            sent.header.stamp = rospy.Time.now()
            self.source.send(sent)
            self.detections.wait_for_stamp(sent.header.stamp)
            rospy.sleep(0.3)
            found = [(t.header.frame_id, t.child_frame_id) for m in transforms.messages for t in m.transforms
                     if t.header.stamp == sent.header.stamp]
            return found if len(found) == 2 * nodes or not frame else []
        found = broadcast() if not frame else support.wait_for(broadcast, "/tf")
        transforms.close()
        return sorted(found)

    def test_tf_is_advertised_only_while_it_is_asked_for(self):
        def advertised():
            publishers = dict(rosgraph.Master("/frames_test").getSystemState()[0])
            return "/detector" in publishers.get("/tf", [])
        with self.node():
            self.answer(synthetic.scene())
            self.assertFalse(advertised())
            client = dynamic_reconfigure.client.Client("/detector", timeout=support.PATIENCE)
            client.update_configuration({"publish_tf": True})
            support.wait_for(advertised, "/tf")
            client.update_configuration({"publish_tf": False})
            support.wait_for(lambda: not advertised(), "the end of /tf")
            client.close()

    def test_detectors_with_prefixes_share_no_frame(self):
        right = support.Node("right", {"codebook": support.CODEBOOK, "publish_tf": True, "tf_prefix": "right",
                                       "tf_frame": "{object}_{number}"})
        with self.node(publish_tf=True, tf_prefix="left"), right:
            self.assertEqual(self.transforms_of(2), [("camera", name) for name in (
                "left/round", "left/thing", "right/round_1", "right/thing_1")])

    def test_an_empty_parent_is_not_broadcast(self):
        with self.node(publish_tf=True) as node:
            self.assertEqual(self.transforms_of(1, ""), [])
            node.wait_for_output("not broadcast on /tf", "no frame_id")
            self.assertEqual(len(self.detections.messages[-1].detections), 2)

    def test_a_pattern_that_names_no_object_is_refused(self):
        with self.node(publish_tf=True, tf_frame="{number}") as node:
            node.wait_for_output("tf_frame = '{number}'", "must hold {object}")
            self.assertEqual(self.transforms_of(1), [("camera", "round"), ("camera", "thing")])


if __name__ == "__main__":
    rospy.init_node("frames_test")
    rostest.rosrun("sks_detector", "frames", FramesTest)
