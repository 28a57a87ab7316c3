#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""While the master is away, killed or standing still, an idle node that would have to subscribe answers and can be ended;
when the master is back, it goes on."""
import signal
import threading
import time
import unittest

import rospy
import rostest
from dynamic_reconfigure.msg import BoolParameter, Config, DoubleParameter, StrParameter
from dynamic_reconfigure.srv import Reconfigure
from std_srvs.srv import SetBool

import support
import synthetic
from own_master import Master, service
from sks_detector.srv import Detect, Info

SOON = 20.0  # [s] far more than anything takes, far less than for ever


class AwayTest(unittest.TestCase):
    def setUp(self):
        self.node = support.Node(parameters={"codebook": support.CODEBOOK, "always_on": False})
        self.info, self.enable = service("info", Info, SOON), service("enable", SetBool, SOON)
        self.reconfigure = service("set_parameters", Reconfigure, SOON)
        self.detect = service("detect", Detect, 3 * support.PATIENCE)
        self.away = False
        self.expect_answers()  # connects them all, as does this
        self.assertIn("no cloud came", self.detect(timeout=0.1).message)

    def tearDown(self):
        if self.away:
            self.come_back()
        if self.node.alive():
            self.assertEqual(self.node.stop(), 0, self.node.output())

    def go_away(self, leave, come_back):
        self.away, self.come_back = True, come_back
        leave()

    def return_again(self):
        self.away = False
        self.come_back()

    def in_background(self, timeout):
        replies = []
        threading.Thread(target=lambda: replies.append(self.detect(timeout=timeout)), daemon=True).start()
        time.sleep(1)  # it is under way
        return replies

    def expect_answers(self):
        """Of all that would wait for what waits for the master."""
        self.assertTrue(self.enable(False).success)
        self.assertTrue(self.enable(True).success)
        self.assertTrue(self.info().codebook.startswith("synthetic ("))
        for value in (0.4, 0.5):
            config = self.reconfigure(Config(doubles=[DoubleParameter("detection.threshold", value)],
                                             bools=[BoolParameter("always_on", value == 0.4)],
                                             strs=[StrParameter("target_frame", "" if value == 0.5 else "map")])).config
            self.assertEqual({d.name: d.value for d in config.doubles}["detection.threshold"], value)

    def expect_a_reason(self):
        start = time.monotonic()
        reply = self.detect(timeout=2)
        self.assertLess(time.monotonic() - start, SOON)
        self.assertFalse(reply.success)
        self.assertIn("within 2 s", reply.message)
        self.assertIn("does not answer", reply.message)

    def expect_to_go_on(self, replies):
        source = support.CloudSource("/points")
        try:
            while not replies:
                if source.publisher.get_num_connections() > 0:
                    source.publisher.publish(support.cloud_message(synthetic.scene()))
                time.sleep(0.1)
            self.assertTrue(replies[0].success, replies[0].message)
            self.assertEqual(sorted(d.object for d in replies[0].detections.detections), ["round", "thing"])
        finally:
            source.publisher.unregister()

    def answer_and_go_on(self, leave, come_back):
        self.go_away(leave, come_back)
        self.expect_a_reason()
        replies = self.in_background(support.PATIENCE)
        self.expect_answers()
        self.assertEqual(replies, [])
        self.return_again()
        self.expect_to_go_on(replies)
        self.expect_answers()

    def end_by_sigterm(self, leave, come_back):
        self.go_away(leave, come_back)
        self.in_background(support.PATIENCE)
        self.reconfigure(Config(bools=[BoolParameter("always_on", True)]))
        start = time.monotonic()
        status = self.node.stop(signal.SIGTERM)
        self.assertLess(time.monotonic() - start, SOON, self.node.output())
        return status

    def test_answers_and_goes_on_where_the_master_was_killed(self):
        self.answer_and_go_on(master.kill, master.start)

    def test_answers_and_goes_on_where_the_master_stood_still(self):
        self.answer_and_go_on(master.stand_still, master.go_on)

    def test_is_ended_by_sigterm_where_the_master_was_killed(self):
        self.assertEqual(self.end_by_sigterm(master.kill, master.start), 0, self.node.output())

    def test_is_ended_by_sigterm_where_the_master_stands_still(self):
        self.end_by_sigterm(master.stand_still, master.go_on)  # with any status: roscpp itself waits for the master

    def test_is_ended_while_it_starts_without_a_master(self):
        self.assertEqual(self.node.stop(), 0)
        self.go_away(master.kill, master.start)
        node = support.Node("second")
        time.sleep(2)
        start = time.monotonic()
        node.stop(signal.SIGTERM)
        self.assertLess(time.monotonic() - start, SOON, node.output())


if __name__ == "__main__":
    master = Master()
    try:
        rospy.init_node("faults_away_test", disable_signals=True)
        rostest.rosrun("sks_detector", "faults_away", AwayTest)
    finally:
        master.go_on()
        master.kill()
