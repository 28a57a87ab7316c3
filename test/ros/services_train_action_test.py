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

LONGEST = rospy.Duration(4 * support.PATIENCE)  # trainings take what others leave of the processor


class TrainActionTest(services_support.ServicesTest):
    def setUp(self):
        self.old = self.succeed("load_codebook", "synthetic.sks").codebook
        self.feedback = []
        self.client = self.new_client()

    def tearDown(self):
        super().tearDown()
        self.node.call("cancel_training")
        self.wait_for_status(lambda s: s.state != Status.TRAINING, "the end of the training")

    def new_client(self):
        client = actionlib.SimpleActionClient("/detector/train_action", TrainAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(support.PATIENCE)))
        return client

    def start(self, client=None, **fields):
        (client or self.client).send_goal(TrainGoal(**fields),
                                          feedback_cb=lambda f: self.feedback.append((time.monotonic(), f)))

    def start_slow(self, **fields):
        self.write_slow_dataset()
        self.start(dataset="slow.yaml", settings=["threads=1"], **fields)
        support.wait_for(lambda: any(f.fraction > 0 for _, f in self.feedback), "a training's progress")

    def outcome(self, client=None):
        """The state of the goal in the end, and its result."""
        client = client or self.client
        self.assertTrue(client.wait_for_result(LONGEST), "the action has no result")
        return client.get_state(), client.get_result()

    def expect_old_codebook(self):
        self.assertEqual(self.succeed("info").codebook, self.old)
        found = self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual({d.object for d in found.detections}, {"round", "thing"})

    def test_trains_saves_and_swaps_in_with_feedback(self):
        self.write_slow_dataset("some.yaml", 200)
        self.start(dataset="some.yaml", name="toys", output="action/toys.sks", settings=["threads=1"])
        state, result = self.outcome()
        self.assertEqual(state, GoalStatus.SUCCEEDED, result)
        self.assertTrue(result.success)
        self.assertRegex(result.codebook, r"^toys \([0-9a-f]{8}\)$")
        self.assertEqual((result.objects, result.views), (1, 200))
        self.assertGreater(result.words, 50)
        self.assertGreater(result.seconds, 0)
        self.assertIn("detecting with " + result.codebook, result.message)
        self.assertEqual(self.client.get_goal_status_text(), result.message)
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
        self.start_slow(output="preempted.sks")
        self.client.cancel_goal()
        state, result = self.outcome()
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertFalse(result.success)
        self.assertRegex(result.message, r"training was cancelled after \d+ of 1000")
        self.assertNotIn("preempted.sks", os.listdir(self.node.codebooks))
        self.expect_old_codebook()
        # and the next goal is taken
        self.start(dataset="synthetic.yaml")
        self.assertEqual(self.outcome()[0], GoalStatus.SUCCEEDED)

    def test_other_ways_of_cancelling_abort(self):
        self.start_slow()
        self.succeed("cancel_training")
        state, result = self.outcome()
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertRegex(result.message, r"training was cancelled after \d+ of 1000")
        self.expect_old_codebook()

    def test_is_refused_while_another_goal_is_trained(self):
        self.start_slow()
        second = self.new_client()
        self.start(second, dataset="synthetic.yaml")
        state, result = self.outcome(second)
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertFalse(result.success)
        self.assertIn("a training runs already", result.message)
        self.assertEqual(second.get_goal_status_text(), result.message)
        self.refuse("train", "a training runs already", dataset="synthetic.yaml")
        self.refuse("load_codebook", "a training runs", path="synthetic.sks")
        self.assertEqual(self.client.get_state(), GoalStatus.ACTIVE, "the first goes on")
        self.client.cancel_goal()
        self.assertEqual(self.outcome()[0], GoalStatus.PREEMPTED)

    def test_is_refused_while_the_service_trains(self):
        self.write_slow_dataset()
        replies = []
        call = threading.Thread(target=lambda: replies.append(
            self.node.call("train", dataset="slow.yaml", settings=["threads=1"])))
        call.start()
        self.wait_for_status(lambda s: s.state == Status.TRAINING and s.progress_fraction > 0, "a training's progress")
        self.start(dataset="synthetic.yaml")
        state, result = self.outcome()
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
                self.start(dataset=name)
                state, result = self.outcome()
                self.assertEqual(state, GoalStatus.ABORTED)
                self.assertFalse(result.success)
                for reason in reasons:
                    self.assertIn(reason, result.message)
                self.assertEqual(self.client.get_goal_status_text(), result.message)
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
