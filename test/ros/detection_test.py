#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the nodelet publishes of good, empty and malformed clouds."""
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import PoseArray, PoseStamped
from sensor_msgs.msg import Image, PointCloud2
from visualization_msgs.msg import Marker, MarkerArray

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


class DetectionTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.detections = support.Recorder("/detector/detections", DetectionArray)
        cls.status = support.Recorder("/detector/status", Status)
        cls.source = support.CloudSource("/points")

    def answer(self, message):
        return self.detections.wait_for_stamp(self.source.send(message))

    def expect_both(self, answer):
        self.assertEqual(sorted(d.object for d in answer.detections), ["round", "thing"])
        for detection in answer.detections:
            name = detection.object
            np.testing.assert_allclose(support.position_of(detection.box_center), synthetic.position(name), atol=0.01)
            difference = np.linalg.inv(synthetic.model_pose(name)) @ support.matrix_of(detection.pose.pose)
            self.assertLess(np.degrees(np.arccos(min(1, (np.trace(difference[:3, :3]) - 1) / 2))), 5)
            self.assertGreaterEqual(detection.score, 0.5)
            self.assertLessEqual(detection.score, 1)
            covariance = np.reshape(detection.pose.covariance, (6, 6))
            np.testing.assert_allclose(covariance, covariance.T)
            deviations = np.sqrt(np.linalg.eigvalsh(covariance[:3, :3]))
            self.assertGreater(deviations[0], 1e-5)  # [m]
            self.assertLess(deviations[2], 0.1)

    def test_finds_both_objects(self):
        answer = self.answer(support.cloud_message(synthetic.scene()))
        self.expect_both(answer)
        self.assertEqual(answer.header.frame_id, "camera")
        self.assertTrue(answer.codebook.startswith("synthetic ("), answer.codebook)
        self.assertGreater(answer.processing_time, 0)

    def test_takes_unorganized_dense_coloured_clouds_and_strips_the_slash(self):
        points = synthetic.scene().reshape(-1, 3)
        points = points[np.isfinite(points).all(1)]
        for field in ("rgb", "rgba"):
            message = support.cloud_message(points, "/camera", None, np.full(points.shape, 99), field)
            answer = self.answer(message)
            self.expect_both(answer)
            self.assertEqual(answer.header.frame_id, "camera")

    def test_answers_unusable_clouds_with_an_empty_array_and_lives_on(self):
        for name, broken, _ in unusable_clouds():
            with self.subTest(name):
                answer = self.answer(broken)
                self.assertEqual(answer.detections, [])
                self.assertEqual(answer.header.frame_id, "camera")
                self.expect_both(self.answer(support.cloud_message(synthetic.scene())))

    def test_names_the_topic_and_the_reason_of_an_unusable_cloud(self):
        self.status.clear()
        for name, broken, reason in unusable_clouds():
            with self.subTest(name):
                def reported():
                    broken.header.stamp = rospy.Time.now()
                    self.answer(broken)
                    return next((s.last_error for s in self.status.messages if reason in s.last_error), None)
                # an error of a kind is reported at most once a second
                self.assertIn("/points", support.wait_for(reported, reason))

    def test_answers_a_scene_without_objects_with_an_empty_array(self):
        self.assertEqual(self.answer(support.cloud_message(synthetic.scene(names=()))).detections, [])

    def test_markers_clear_first_and_an_empty_scene_clears(self):
        markers = support.Recorder("/detector/markers", MarkerArray)
        support.wait_for(lambda: markers.connections() > 0, "a connection to the markers")
        stamp = self.answer(support.cloud_message(synthetic.scene())).header.stamp
        shown = markers.wait_for(lambda m: len(m.markers) > 1 and m.markers[1].header.stamp == stamp).markers
        self.assertEqual([m.action for m in shown], [Marker.DELETEALL] + 6 * [Marker.ADD])
        self.assertEqual({m.header.frame_id for m in shown}, {"camera"})
        boxes = {m.id: m for m in shown if m.ns == "boxes"}
        labels = {m.id: m for m in shown if m.ns == "labels"}
        self.assertEqual(sorted(m.text.split()[0] for m in labels.values()), ["round", "thing"])
        for index, box in boxes.items():
            name = labels[index].text.split()[0]
            np.testing.assert_allclose(support.position_of(box.pose), synthetic.position(name), atol=0.01)
            self.assertEqual(len(box.points), 24)
            color = {"thing": (240, 120, 0), "round": (24, 168, 240)}[name]  # in the order of the codebook
            for marker in (box, labels[index]):
                np.testing.assert_allclose([marker.color.r, marker.color.g, marker.color.b], np.array(color) / 255)
            self.expect_label_above(labels[index], box)
        markers.clear()
        self.answer(support.cloud_message(synthetic.scene(names=())))
        cleared = markers.wait_for(lambda m: len(m.markers) == 1).markers
        self.assertEqual(cleared[0].action, Marker.DELETEALL)
        markers.close()

    def expect_label_above(self, label, box):
        """As the camera sees it; nearer to it than the box, and of a size that can be read from there."""
        center, place = support.position_of(box.pose), support.position_of(label.pose)
        corners = np.column_stack([[[p.x, p.y, p.z] for p in box.points], np.ones(24)]) @ support.matrix_of(box.pose).T
        corners = corners[:, :3]
        self.assertLess(place[1] / place[2] + 0.4 * label.scale.z, (corners[:, 1] / corners[:, 2]).min() + 0.01)
        self.assertAlmostEqual(place[0] / place[2], center[0] / center[2], delta=0.01)
        self.assertLess(np.linalg.norm(place), np.linalg.norm(center))
        self.assertAlmostEqual(label.scale.z / np.linalg.norm(center), 0.04, delta=0.005)

    def test_poses_come_in_standard_messages(self):
        poses = support.Recorder("/detector/poses", PoseArray)
        best = {name: support.Recorder("/detector/objects/%s/pose" % name, PoseStamped) for name in ("thing", "round")}
        support.wait_for(lambda: poses.connections() and all(b.connections() for b in best.values()), "connections")
        answer = self.answer(support.cloud_message(synthetic.scene()))
        message = poses.wait_for_stamp(answer.header.stamp)
        self.assertEqual(message.header.frame_id, "camera")
        self.assertEqual(message.poses, [d.pose.pose for d in answer.detections])
        for detection in answer.detections:
            message = best[detection.object].wait_for_stamp(answer.header.stamp)
            self.assertEqual((message.header.frame_id, message.pose), ("camera", detection.pose.pose))
        answer = self.answer(support.cloud_message(synthetic.scene(names=("round",))))
        self.assertEqual(len(poses.wait_for_stamp(answer.header.stamp).poses), 1)
        best["round"].wait_for_stamp(answer.header.stamp)
        self.assertEqual(len(best["thing"].messages), 1)
        for recorder in (poses, *best.values()):
            recorder.close()

    def test_draws_a_picture_for_who_asks(self):
        pictures = support.Recorder("/detector/image_overlay", Image)
        support.wait_for(pictures.connections, "a connection")
        stamp = self.answer(support.cloud_message(synthetic.scene())).header.stamp
        picture = pictures.wait_for_stamp(stamp)
        self.assertEqual((picture.header.frame_id, picture.encoding, picture.width, picture.height),
                         ("camera", "rgb8", 640, 480))
        pixels = np.frombuffer(picture.data, np.uint8).reshape(480, 640, 3)
        for color in ((240, 120, 0), (24, 168, 240)):  # boxes and plates of labels, in the order of the codebook
            self.assertGreater((pixels == color).all(2).sum(), 300)
        pictures.close()

    def test_shows_keypoints_and_votes_to_who_asks(self):
        keypoints = support.Recorder("/detector/keypoints", PointCloud2)
        votes = support.Recorder("/detector/votes", PointCloud2)
        support.wait_for(lambda: keypoints.connections() and votes.connections(), "connections")
        stamp = self.source.send(support.cloud_message(synthetic.scene()))
        for cloud, fields in ((keypoints.wait_for_stamp(stamp), "xyz"), (votes.wait_for_stamp(stamp), "xyzrgb")):
            self.assertEqual("".join(f.name for f in cloud.fields), fields)
            self.assertEqual(cloud.header.frame_id, "camera")
            self.assertGreater(cloud.width * cloud.height, 50)
            points = support.points_of(cloud)
            self.assertTrue(np.isfinite(points).all())
            self.assertLess(np.abs(points - [0, 0, 0.9]).max(), 0.6)
        near = np.linalg.norm(support.points_of(votes.messages[0]) - synthetic.position("thing"), axis=1) < 0.02
        self.assertGreater(near.sum(), 20)
        keypoints.close()
        votes.close()


def unusable_clouds():
    """(name, message, part of the reason)"""
    def changed(change, points=None):
        message = support.cloud_message(synthetic.scene(("thing",)) if points is None else points)
        change(message)
        return message

    def without_z(message):
        del message.fields[2]

    def integers(message):
        for field in message.fields:
            field.datatype = 5

    def far_offset(message):
        message.fields[1].offset = 4000000000

    return [
        ("empty", changed(lambda m: None, np.zeros((0, 3))), "empty (0 points)"),
        ("nothing at all", support.PointCloud2(header=support.cloud_message(np.zeros((1, 3))).header), "empty (0 points)"),
        ("all NaN", changed(lambda m: None, np.full((120, 160, 3), np.nan)), "19200 are NaN"),
        ("no z", changed(without_z), "no field 'z'"),
        ("integers", changed(integers), "holds integers"),
        ("big-endian", changed(lambda m: setattr(m, "is_bigendian", True)), "big-endian"),
        ("truncated", changed(lambda m: setattr(m, "data", m.data[:-1])), "but holds 230399 bytes"),
        ("too long", changed(lambda m: setattr(m, "data", m.data + b"0")), "but holds 230401 bytes"),
        ("points without bytes", changed(lambda m: setattr(m, "point_step", 0)), "but holds"),
        ("field outside", changed(far_offset), "field 'y' lies outside"),
        ("millimetres", changed(lambda m: None, 1000 * synthetic.scene()), "what publishes clouds to ROS must send metres"),
    ]


if __name__ == "__main__":
    rospy.init_node("detection_test")
    rostest.rosrun("sks_detector", "detection", DetectionTest)
