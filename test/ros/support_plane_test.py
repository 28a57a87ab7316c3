#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""~support: the plane that is seen, in the frame of the detections, for who listens."""
import unittest

import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import TransformStamped

import support
import synthetic
from sks_detector.msg import DetectionArray, Support

# The wall's side to the camera, in synthetic.scene().
WALL = synthetic.pose(10, (0, 1, 0), (0, 0, 1.1)) @ synthetic.pose(0, (0, 0, 1), (0, 0, -0.02))
# What the camera's picture shows of it [m].
WIDE, HIGH = 160 * 0.0025 * 1.1, 120 * 0.0025 * 1.1


class SupportPlaneTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.planes = support.Recorder("/detector/support", Support)  # and nothing else: for it alone the node works
        cls.source = support.CloudSource("/points")
        cls.client = dynamic_reconfigure.client.Client("/detector", timeout=support.PATIENCE)
        cls.broadcaster = tf2_ros.StaticTransformBroadcaster()

    def expect_wall(self, plane, T_frame_camera=np.eye(4)):
        self.assertTrue(plane.found)
        T = np.linalg.inv(T_frame_camera @ WALL) @ support.matrix_of(plane.pose)
        self.assertLess(T[2, 2], -np.cos(np.radians(1)), "the normal is to the side of the camera")
        self.assertLess(abs(T[2, 3]), 0.003)
        np.testing.assert_allclose(T[:2, 3], [0, 0], atol=0.02)
        self.assertGreater(abs(T[0, 0]), 0.995, "x is along the longer side")
        np.testing.assert_allclose([plane.size_x, plane.size_y], [WIDE, HIGH], atol=0.04)
        outline = np.array([[p.x, p.y, p.z] for p in plane.outline])
        np.testing.assert_allclose(np.ptp(outline, axis=0), [plane.size_x, plane.size_y, 0], atol=1e-3)
        x, y = outline[:, 0], outline[:, 1]
        area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
        self.assertAlmostEqual(area, WIDE * HIGH, delta=0.03)

    def test_is_told_to_who_listens_to_nothing_else(self):
        stamp = self.source.send(support.cloud_message(synthetic.scene()))
        plane = self.planes.wait_for_stamp(stamp)
        self.assertEqual(plane.header.frame_id, "camera")
        self.expect_wall(plane)

    def test_comes_in_the_frame_of_the_detections(self):
        T = synthetic.pose(90, (1, 0, 0), (1, 2, 3))
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "base_link", "camera"
        transform.header.stamp = rospy.Time.now()
        t, r = transform.transform.translation, transform.transform.rotation
        t.x, t.y, t.z = 1, 2, 3
        r.x = r.w = np.sqrt(0.5)
        self.broadcaster.sendTransform(transform)
        self.client.update_configuration({"target_frame": "base_link", "tf_timeout": 5.0})
        self.addCleanup(self.client.update_configuration, {"target_frame": "", "tf_timeout": 0.2})
        plane = self.planes.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene())))
        self.assertEqual(plane.header.frame_id, "base_link")
        self.expect_wall(plane, T)

    def test_comes_with_tracking(self):
        self.client.update_configuration({"tracking": True})
        self.addCleanup(self.client.update_configuration, {"tracking": False})
        self.expect_wall(self.planes.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene()))))

    def test_is_not_found_where_there_is_none(self):
        no_wall = support.cloud_message(synthetic.scene(wall=False))
        unusable = support.cloud_message(np.full((10, 10, 3), np.nan))
        for cloud in (no_wall, unusable):
            plane = self.planes.wait_for_stamp(self.source.send(cloud))
            self.assertFalse(plane.found)
            self.assertEqual((plane.size_x, plane.size_y, plane.outline, plane.standing), (0, 0, [], 0))

    def test_tells_what_stands_on_it(self):
        """A board right behind both objects."""
        boxes = support.Recorder("/detector/detections", DetectionArray)
        support.wait_for(boxes.connections, "a connection")
        self.addCleanup(boxes.close)
        back = synthetic.position("thing")[2] + 0.08
        board = ([(synthetic.BOX, (0, 0, 0), (1, 1, 0.01))], synthetic.pose(0, (0, 0, 1), (0, 0, back + 0.01)))
        cloud = synthetic.view([(synthetic.SHAPES["thing"], synthetic.PLACED["thing"]), board])
        stamp = self.source.send(support.cloud_message(cloud))
        plane = self.planes.wait_for_stamp(stamp)
        self.assertTrue(plane.found)
        self.assertAlmostEqual(plane.pose.position.z, back, delta=0.003)
        self.assertEqual([d.object for d in boxes.wait_for_stamp(stamp).detections], ["thing"])
        self.assertEqual(plane.standing, 1)


if __name__ == "__main__":
    rospy.init_node("support_plane_test")
    rostest.rosrun("sks_detector", "support_plane", SupportPlaneTest)
