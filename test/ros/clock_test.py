#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Time: the clock jumps back, clouds are old, clouds stay away."""
import re
import threading
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Clock

import support
import synthetic
from sks_detector.msg import DetectionArray


class SimulatedClock:
    """Publishes /clock, as a bag does."""

    def __init__(self, start):
        self._now = start
        self._lock = threading.Lock()
        self._publisher = rospy.Publisher("/clock", Clock, queue_size=10)
        self._thread = threading.Thread(target=self._tick, daemon=True)
        self._thread.start()

    def _tick(self):
        while not rospy.is_shutdown():
            with self._lock:
                self._now += 0.01
                self._publisher.publish(Clock(rospy.Time(self._now)))
            threading.Event().wait(0.01)

    def jump(self, to):
        with self._lock:
            self._now = to
        support.wait_for(lambda: abs(rospy.get_time() - to) < 50, "the jump")


class ClockTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.clock = SimulatedClock(1000.0)
        cls.source = support.CloudSource("/points")
        support.wait_for(lambda: rospy.get_time() > 0, "the clock")

    def setUp(self):
        self.detections = support.Recorder("/detector/detections", DetectionArray)

    def tearDown(self):
        self.detections.close()

    def node(self, **parameters):
        return support.Node(parameters=dict(parameters, codebook=support.CODEBOOK))

    def expect_answer(self):
        answer = support.answer(self.source, support.cloud_message(synthetic.scene()), self.detections)
        self.assertEqual(len(answer.detections), 2)

    def expect_time(self, diagnostics):
        """Waits until the node knows the time: its first answers may come before its first message of /clock."""
        diagnostics.wait_for(lambda m: abs((m.header.stamp - rospy.Time.now()).to_sec()) < 50 and
                             any(s.name.startswith("detector:") for s in m.status), "the time of the node")

    def test_goes_on_after_time_jumped_back(self):
        diagnostics = support.Recorder("/diagnostics", DiagnosticArray)
        with self.node(max_input_age=30.0) as node:
            self.expect_time(diagnostics)
            self.expect_answer()
            for jump in (450, 350):
                self.clock.jump(rospy.get_time() - jump)
                node.wait_for_output("time jumped back by %d" % (jump // 100), "are forgotten")
                self.expect_answer()
            self.assertTrue(node.alive())
        diagnostics.close()

    def test_drops_old_clouds_and_says_so(self):
        diagnostics = support.Recorder("/diagnostics", DiagnosticArray)
        with self.node(max_input_age=30.0) as node:
            self.expect_time(diagnostics)
            self.expect_answer()
            old = self.source.send(support.cloud_message(synthetic.scene(), stamp=rospy.Time.now() - rospy.Duration(90)))
            node.wait_for_output("/points are dropped", "~max_input_age")
            message = diagnostics.wait_for(
                lambda m: any("dropped by ~max_input_age" in s.message for s in m.status), "the dropped cloud")
            age = next(re.search(r"they are ([0-9.]+) s old", s.message) for s in message.status if "dropped" in s.message)
            self.assertGreaterEqual(float(age.group(1)), 90)
            self.expect_answer()
            self.assertNotIn(old, [m.header.stamp for m in self.detections.messages])
        diagnostics.close()

    def test_warns_of_silence(self):
        diagnostics = support.Recorder("/diagnostics", DiagnosticArray)
        with self.node(silence_warning=0.5) as node:
            node.wait_for_output("no cloud on /points for more than 0.5 s", "it has 1 publisher")
            diagnostics.wait_for(
                lambda m: any(s.name == "detector: Input" and "no cloud on /points" in s.message for s in m.status))
            self.expect_answer()
        diagnostics.close()


if __name__ == "__main__":
    rospy.init_node("clock_test")
    rostest.rosrun("sks_detector", "clock", ClockTest)
