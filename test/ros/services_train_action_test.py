#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Training by action: feedback, preemption, and what is refused."""
import os
import threading
import time

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

import services_support
import support
import synthetic
from sks_detector.msg import Status, TrainAction, TrainGoal

LONGEST = 4 * support.PATIENCE  # [s] trainings take what others leave of the processor


class Goal:
    """A goal that is followed. (actionlib.SimpleActionClient loses an answer that arrives before its send_goal returns,
    as that of a refused goal can.)"""

    def __init__(self, client, feedback, **fields):
        self.done = threading.Event()
        self.handle = client.send_goal(TrainGoal(**fields), self.follow, lambda handle, message: feedback(message))

    def follow(self, handle):
        if handle.get_comm_state() == actionlib.CommState.DONE:
            self.done.set()


class TrainActionTest(services_support.ServicesTest):
    def setUp(self):
        self.old = self.succeed("load_codebook", "synthetic.sks").codebook
        self.feedback = []
        self.client = actionlib.ActionClient("/detector/train_action", TrainAction)
        self.assertTrue(self.client.wait_for_server(rospy.Duration(support.PATIENCE)))

    def tearDown(self):
        super().tearDown()
        self.node.call("cancel_training")
        self.wait_for_status(lambda s: s.state != Status.TRAINING, "the end of the training")

    def start(self, **fields):
        return Goal(self.client, lambda f: self.feedback.append((time.monotonic(), f)), **fields)

    def start_slow(self, **fields):
        self.write_slow_dataset()
        goal = self.start(dataset="slow.yaml", settings=["threads=1"], **fields)
        support.wait_for(lambda: any(f.fraction > 0 for _, f in self.feedback), "a training's progress")
        return goal

    def outcome(self, goal):
        """The state of the goal in the end, its result and its text."""
        self.assertTrue(goal.done.wait(LONGEST), "the action has no result")
        return goal.handle.get_goal_status(), goal.handle.get_result(), goal.handle.get_goal_status_text()

    def expect_old_codebook(self):
        self.assertEqual(self.succeed("info").codebook, self.old)
        found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual({d.object for d in found.detections}, {"round", "thing"})

    def test_trains_saves_and_swaps_in_with_feedback(self):
        self.write_slow_dataset("some.yaml", 200)
        state, result, text = self.outcome(
            self.start(dataset="some.yaml", name="toys", output="action/toys.sks", settings=["threads=1"]))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result)
        self.assertTrue(result.success)
        self.assertRegex(result.codebook, r"^toys \([0-9a-f]{8}\)$")
        self.assertEqual((result.objects, result.views), (1, 200))
        self.assertGreater(result.words, 50)
        self.assertGreater(result.seconds, 0)
        self.assertIn("detecting with " + result.codebook, result.message)
        self.assertEqual(text, result.message)
        info = self.succeed("info")
        self.assertEqual(info.codebook, result.codebook)
        self.assertEqual(info.codebook_file, os.path.join(self.node.codebooks, "action/toys.sks"))
        self.expect_feedback(result.seconds)

    def expect_feedback(self, seconds):
        texts, fractions = [f.progress for _, f in self.feedback], [f.fraction for _, f in self.feedback]
        self.assertGreater(len(texts), 0)
        for text in texts:
            self.assertRegex(text, r"^[a-z ]+ \d+ of 200(: thing\.pcd)?")
        self.assertTrue(all(0 <= f <= 1 for f in fractions), fractions)
        self.assertLessEqual(len(texts), 2 + 4 * seconds, "a few a second")

    def test_preemption_cancels_and_keeps_the_old_codebook(self):
        goal = self.start_slow(output="preempted.sks")
        goal.handle.cancel()
        state, result, _ = self.outcome(goal)
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertFalse(result.success)
        self.assertRegex(result.message, r"training was cancelled after \d+ of 1000")
        self.assertNotIn("preempted.sks", os.listdir(self.node.codebooks))
        self.expect_old_codebook()
        # and the next goal is taken
        self.assertEqual(self.outcome(self.start(dataset="synthetic.yaml"))[0], GoalStatus.SUCCEEDED)

    def test_other_ways_of_cancelling_abort(self):
        goal = self.start_slow()
        self.succeed("cancel_training")
        state, result, _ = self.outcome(goal)
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertRegex(result.message, r"training was cancelled after \d+ of 1000")
        self.expect_old_codebook()

    def test_is_refused_while_another_goal_is_trained(self):
        first = self.start_slow()
        state, result, text = self.outcome(self.start(dataset="synthetic.yaml"))
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertFalse(result.success)
        self.assertIn("a training runs already", result.message)
        self.assertEqual(text, result.message)
        self.refuse("train", "a training runs already", dataset="synthetic.yaml")
        self.refuse("load_codebook", "a training runs", path="synthetic.sks")
        self.assertEqual(first.handle.get_goal_status(), GoalStatus.ACTIVE, "the first goes on")
        first.handle.cancel()
        self.assertEqual(self.outcome(first)[0], GoalStatus.PREEMPTED)

    def test_is_refused_while_the_service_trains(self):
        self.write_slow_dataset()
        replies = []
        call = threading.Thread(target=lambda: replies.append(
            self.node.call("train", dataset="slow.yaml", settings=["threads=1"])))
        call.start()
        self.wait_for_status(lambda s: s.state == Status.TRAINING and s.progress_fraction > 0, "a training's progress")
        state, result, _ = self.outcome(self.start(dataset="synthetic.yaml"))
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertIn("a training runs already", result.message)
        self.assertEqual(self.feedback, [])
        self.succeed("cancel_training")
        call.join()
        self.assertIn("cancelled", replies[0].message)

    def test_a_data_set_that_fails_is_named(self):
        self.write_dataset("broken.yaml", [{"object": "thing", "cloud": "missing.pcd", "kind": "view"}])
        for name, reasons in (("broken.yaml", ["missing.pcd"]), ("none.yaml", ["none.yaml"]),
                              ("../secret.yaml", ["outside", self.node.datasets])):
            with self.subTest(name):
                state, result, text = self.outcome(self.start(dataset=name))
                self.assertEqual(state, GoalStatus.ABORTED)
                self.assertFalse(result.success)
                for reason in reasons:
                    self.assertIn(reason, result.message)
                self.assertEqual(text, result.message)
                self.status.wait_for(lambda s: result.message in s.last_error, "the error in the status")
        self.expect_old_codebook()

    def test_node_ends_quickly_while_it_trains(self):
        self.start_slow(output="ended.sks")
        self.assertEqual(self.node.stop(), 0)
        self.assertNotIn("ended.sks", os.listdir(self.node.codebooks))
        self.status.clear()
        self.node.start()


if __name__ == "__main__":
    rospy.init_node("services_train_action_test")
    rostest.rosrun("sks_detector", "services_train_action", TrainActionTest)
