#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""planning_scene_node: what comes into a planning scene, moves in it and goes."""
import signal
import subprocess
import threading
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Point32
from moveit_msgs.msg import CollisionObject, PlanningScene
from object_recognition_msgs.msg import TableArray
from sks_detector.msg import Detection, DetectionArray, Support
from shape_msgs.msg import SolidPrimitive
from std_srvs.srv import Trigger

import support

ADD_AFTER, REMOVE_AFTER, THICKNESS, FRAME_TIME = 2, 1.0, 0.05, 0.1


class MoveGroup:
    """Applies diffs as MoveIt does: what is added replaces what has its id."""

    def __init__(self):
        self.objects = {}
        self.diffs = 0
        self._lock = threading.Lock()
        self._subscriber = rospy.Subscriber("/planning_scene", PlanningScene, self._apply)

    def _apply(self, scene):
        with self._lock:
            assert scene.is_diff and scene.robot_state.is_diff
            self.diffs += 1
            for item in scene.world.collision_objects:
                if item.operation == CollisionObject.ADD:
                    self.objects[item.id] = item
                else:
                    assert item.operation == CollisionObject.REMOVE
                    self.objects.pop(item.id, None)

    def state(self):
        with self._lock:
            return dict(self.objects)

    def wait_for_ids(self, *ids):
        support.wait_for(lambda: sorted(self.state()) == sorted(ids), "the objects %s in the scene" % (ids,), 20)
        return self.state()

    def connected(self):
        return self._subscriber.get_num_connections() > 0

    def close(self):
        self._subscriber.unregister()


def detection(name="mug", x=0.0, score=0.9, number=0):
    found = Detection(object=name, score=score, id=number)
    found.box_center.position.x, found.box_center.position.z = x, 1
    found.box_center.orientation.w = found.pose.pose.orientation.w = 1
    found.box_size.x, found.box_size.y, found.box_size.z = 0.1, 0.06, 0.2
    return found


def plane():
    found = Support(found=True, size_x=0.8, size_y=0.6, standing=1)
    found.pose.position.z = 1.1
    found.pose.orientation.x = 1  # faces the camera
    found.outline = [Point32(x, y, 0) for x, y in ((-0.4, -0.3), (0.4, -0.3), (0.4, 0.3), (-0.4, 0.3))]
    return found


class PlanningSceneTest(unittest.TestCase):
    def setUp(self):
        # anew for each node: rospy counts the connections of nodes that have gone
        self.detections = rospy.Publisher("/detector/detections", DetectionArray, queue_size=100)
        self.supports = rospy.Publisher("/detector/support", Support, queue_size=100)
        self.addCleanup(self.detections.unregister)
        self.addCleanup(self.supports.unregister)
        self.stamp = rospy.Time(1000)
        self.move_group = MoveGroup()
        self.addCleanup(self.move_group.close)
        if "launch_file" in self.id():
            self.launch()
        else:
            self.start()
        support.wait_for(self.connected, "connections of the node")

    def start(self):
        self.node = support.Node("scene", {"add_after": ADD_AFTER, "remove_after": REMOVE_AFTER,
                                           "support_thickness": THICKNESS, **self.parameters()},
                                 ["~detections:=/detector/detections", "~support:=/detector/support"],
                                 executable="planning_scene_node")
        self.node.__enter__()
        self.addCleanup(self.node.__exit__)

    def launch(self):
        launched = subprocess.Popen(["roslaunch", "sks_detector", "planning_scene.launch", "name:=launched", "add_after:=1",
                                     "respawn:=false", "support_thickness:=0.1"])
        self.addCleanup(launched.wait, support.PATIENCE)
        self.addCleanup(launched.send_signal, signal.SIGINT)

    def parameters(self):
        """What a test of this name wants beside."""
        wanted = {"low_score": {"min_score": 0.6}, "wrong_parameters": {"add_after": 0, "min_scor": 0.9}}
        return next((parameters for name, parameters in wanted.items() if name in self.id()), {})

    def connected(self):
        return (self.detections.get_num_connections() and self.supports.get_num_connections() and
                self.move_group.connected())

    def header(self, message, frame):
        self.stamp += rospy.Duration(FRAME_TIME)
        message.header.stamp, message.header.frame_id = self.stamp, frame
        return message

    def see(self, *found, frame="camera"):
        self.detections.publish(self.header(DetectionArray(detections=list(found)), frame))

    def settle(self, *found, frame="camera"):
        for _ in range(ADD_AFTER):
            self.see(*found, frame=frame)

    def see_support(self, message, frame="camera"):
        self.supports.publish(self.header(message, frame))

    def test_the_messages_are_those_of_noetic(self):
        self.assertEqual(PlanningScene._md5sum, "acfc50bcfd6c7b978066bfa7c786002c")
        self.assertEqual(CollisionObject._md5sum, "dbba710596087da521c07564160dfccb")
        self.assertEqual(TableArray._md5sum, "d1c853e5acd0ed273eb6682dc01ab428")

    def test_an_object_is_added_after_some_frames(self):
        self.see(detection())
        rospy.sleep(0.3)
        self.assertEqual(self.move_group.state(), {})
        self.see(detection())
        added = self.move_group.wait_for_ids("object_1")["object_1"]
        self.assertEqual((added.header.frame_id, added.header.stamp), ("camera", self.stamp))
        self.assertEqual(added.type.key, "mug")
        self.assertEqual(added.pose.orientation.w, 1)
        self.assertEqual([p.type for p in added.primitives], [SolidPrimitive.BOX])
        np.testing.assert_allclose(added.primitives[0].dimensions, [0.1, 0.06, 0.2])
        self.assertEqual(added.primitive_poses, [detection().box_center])

    def test_what_moves_is_moved_and_what_jitters_is_not(self):
        self.settle(detection(), detection("jug", 0.5))
        self.move_group.wait_for_ids("object_1", "object_2")
        diffs = self.move_group.diffs
        for shift in (0.003, -0.004, 0.002):
            self.see(detection(x=shift), detection("jug", 0.5 + shift))
        self.see(detection(x=0.03), detection("jug", 0.5))
        support.wait_for(lambda: self.move_group.state()["object_1"].primitive_poses[0].position.x == 0.03, "a move", 20)
        self.assertEqual(self.move_group.diffs, diffs + 1)
        self.assertEqual(self.move_group.state()["object_2"].primitive_poses[0].position.x, 0.5)

    def test_a_followed_object_keeps_its_id_wherever_it_goes(self):
        self.settle(detection(number=7), detection(x=0.5, number=9))
        self.move_group.wait_for_ids("object_1", "object_2")
        self.see(detection(x=0.5, number=7), detection(number=9))

        def changed():
            state = self.move_group.state()
            return [state["object_%d" % i].primitive_poses[0].position.x for i in (1, 2)] == [0.5, 0]
        support.wait_for(changed, "both to have changed places", 20)

    def test_what_is_no_longer_seen_is_removed_after_a_while(self):
        self.settle(detection(), detection("jug", 0.5))
        self.move_group.wait_for_ids("object_1", "object_2")
        for _ in range(int(0.7 * REMOVE_AFTER / FRAME_TIME)):
            self.see(detection("jug", 0.5))
        rospy.sleep(0.3)
        self.move_group.wait_for_ids("object_1", "object_2")
        for _ in range(int(0.6 * REMOVE_AFTER / FRAME_TIME)):
            self.see(detection("jug", 0.5))
        self.move_group.wait_for_ids("object_2")

    def test_a_low_score_does_not_count(self):
        for _ in range(2 * ADD_AFTER):
            self.see(detection(score=0.55), detection("jug", 0.5, score=0.65))
        self.assertEqual(self.move_group.wait_for_ids("object_1")["object_1"].type.key, "jug")

    def test_a_detection_without_numbers_is_passed_over(self):
        broken = detection()
        broken.box_center.position.x = float("nan")
        self.settle(broken, detection("jug", 0.5))
        self.assertEqual(self.move_group.wait_for_ids("object_1")["object_1"].type.key, "jug")
        self.node.wait_for_output("not added to the planning scene", "not finite")

    def test_the_support_is_a_box_below_its_plane_and_a_table(self):
        tables = support.Recorder("/table_array", TableArray)
        support.wait_for(tables.connections, "a connection to the tables")
        for _ in range(ADD_AFTER):
            self.see_support(plane())
        added = self.move_group.wait_for_ids("support")["support"]
        np.testing.assert_allclose(added.primitives[0].dimensions, [0.8, 0.6, THICKNESS])
        position = support.position_of(added.primitive_poses[0])
        np.testing.assert_allclose(position, [0, 0, 1.1 + 0.5 * THICKNESS], err_msg="behind, as the camera sees it")
        table = tables.wait_for_stamp(self.stamp).tables[0]
        self.assertEqual((table.header.frame_id, table.pose), ("camera", plane().pose))
        self.assertEqual([(round(p.x, 3), round(p.y, 3), p.z) for p in table.convex_hull],
                         [(-0.4, -0.3, 0), (0.4, -0.3, 0), (0.4, 0.3, 0), (-0.4, 0.3, 0)])
        for _ in range(int(1.5 * REMOVE_AFTER / FRAME_TIME)):
            self.see_support(Support())
        self.move_group.wait_for_ids()
        self.assertEqual(tables.wait_for_stamp(self.stamp).tables, [])
        tables.close()

    def test_clear_removes_all_and_what_is_still_seen_comes_again(self):
        self.settle(detection(), detection("jug", 0.5))
        for _ in range(ADD_AFTER):
            self.see_support(plane())
        self.move_group.wait_for_ids("object_1", "object_2", "support")
        rospy.wait_for_service("/scene/clear", support.PATIENCE)
        answer = rospy.ServiceProxy("/scene/clear", Trigger)()
        self.assertEqual((answer.success, answer.message), (True, "removed 3 objects"))
        self.move_group.wait_for_ids()
        self.settle(detection())
        self.move_group.wait_for_ids("object_3")

    def test_another_frame_and_a_clock_that_jumps_back_begin_anew(self):
        self.settle(detection())
        self.move_group.wait_for_ids("object_1")
        self.settle(detection(), frame="base_link")
        self.assertEqual(self.move_group.wait_for_ids("object_2")["object_2"].header.frame_id, "base_link")
        self.stamp = rospy.Time(500)
        self.settle(detection(), frame="base_link")
        self.move_group.wait_for_ids("object_3")
        self.assertIn("begun anew", self.node.wait_for_output("time jumped back"))

    def test_who_comes_later_gets_all(self):
        self.settle(detection(), detection("jug", 0.5))
        self.move_group.wait_for_ids("object_1", "object_2")
        self.move_group.close()  # subscribers of one process share a connection
        late = MoveGroup()
        self.addCleanup(late.close)
        self.assertEqual(late.wait_for_ids("object_1", "object_2")["object_2"].type.key, "jug")

    def test_the_launch_file_connects_it_with_the_detector(self):
        self.see(detection())
        self.see_support(plane())
        state = self.move_group.wait_for_ids("object_1", "support")
        self.assertEqual(state["support"].primitives[0].dimensions[2], 0.1)

    def test_wrong_parameters_are_named_and_the_defaults_used(self):
        self.node.wait_for_output("add_after", "is used")
        self.node.wait_for_output("min_scor", "min_score")
        self.settle(detection())
        rospy.sleep(0.3)
        self.assertEqual(self.move_group.state(), {})
        self.see(detection())  # the third
        self.move_group.wait_for_ids("object_1")

    def test_the_node_takes_what_it_added_with_it(self):
        self.settle(detection())
        self.move_group.wait_for_ids("object_1")
        self.assertEqual(self.node.stop(), 0)
        self.move_group.wait_for_ids()


if __name__ == "__main__":
    rospy.init_node("planning_scene_test")
    rostest.rosrun("sks_detector", "planning_scene", PlanningSceneTest)
