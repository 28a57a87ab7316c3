#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The values of /diagnostics: they add up to what was sent."""
import signal
import unittest

import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import Image

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


class DiagnosticsTest(unittest.TestCase):
    def setUp(self):
        self.diagnostics = support.Recorder("/diagnostics", DiagnosticArray)
        self.detections = support.Recorder("/detector/detections", DetectionArray)
        self.source = support.CloudSource("/points")

    def tearDown(self):
        self.detections.close()
        self.diagnostics.close()
        self.source.publisher.unregister()

    def wait_for(self, part, condition, what):
        """Level, message and values of the first status of a part that fulfils the condition."""
        def first():
            for status in [s for m in self.diagnostics.messages for s in m.status if s.name == "detector: " + part]:
                values = {value.key: value.value for value in status.values}
                if condition(status, values):
                    return status.level, status.message, values
            return None
        return support.wait_for(first, what)

    def test_counts_and_times_add_up(self):
        with support.Node(parameters={"codebook": support.CODEBOOK}) as node:
            self.source.wait_for_subscriber()
            latencies = []
            for _ in range(5):
                message = support.cloud_message(synthetic.scene())
                answer = self.detections.wait_for_stamp(self.source.send(message))
                latencies.append(1000 * answer.processing_time)
            _, _, values = self.wait_for("Detection", lambda s, v: v["processed"] == "5", "five processed clouds")
            self.assertEqual(values["unusable"], "0")
            p50, p95, longest = [float(values["latency %s [ms]" % name]) for name in ("p50", "p95", "max")]
            self.assertLessEqual(p50, p95)
            self.assertLessEqual(p95, longest)
            # from receipt to publishing, like processing_time, but for what lies between the two readings of the clock
            self.assertGreaterEqual(longest, max(latencies) - 0.1)
            self.assertGreaterEqual(p50, np.median(latencies) - 0.1)

            _, message, values = self.wait_for("Input", lambda s, v: v["received"] == "5", "five received clouds")
            self.assertEqual((values["topic"], values["publishers"]), ("/points", "1"))
            self.assertEqual((values["dropped for newer ones"], values["dropped as too old"]), ("0", "0"))
            self.assertGreater(float(values["age [s]"]), 0)
            self.assertLess(float(values["age [s]"]), support.PATIENCE)
            self.assertTrue(node.alive())

    def test_drops_are_counted_and_the_rate_is_that_of_the_input(self):
        with support.Node(parameters={"codebook": support.CODEBOOK}):
            self.source.wait_for_subscriber()
            sent = 0
            start = rospy.get_time()
            while rospy.get_time() < start + 6:
                self.source.send(support.cloud_message(synthetic.scene()))
                sent += 1
                rospy.sleep(0.02)
            rate = sent / (rospy.get_time() - start)
            rates = [float(v.value) for m in self.diagnostics.messages for s in m.status for v in s.values
                     if v.key == "rate [Hz]" and float(v.value) > 0]
            self.assertTrue(0.5 * rate < np.median(rates) < 2 * rate, "%s, %.1f Hz sent" % (rates, rate))
            _, _, values = self.wait_for("Input", lambda s, v: v["received"] == str(sent), "%d received clouds" % sent)
            dropped = int(values["dropped for newer ones"])
            self.wait_for("Detection", lambda s, v: int(v["processed"]) + dropped == sent, "all accounted for")

    def test_what_is_lost_while_the_node_stands_still_is_counted(self):
        with support.Node(parameters={"codebook": support.CODEBOOK}) as node:
            self.source.wait_for_subscriber()
            scene, sent = synthetic.scene(), 60
            self.detections.wait_for_stamp(self.source.send(support.cloud_message(scene)))
            rate = rospy.Rate(10)
            for number in range(1, sent):
                if number == 15:
                    node.send_signal(signal.SIGSTOP)
                if number == 45:
                    node.send_signal(signal.SIGCONT)
                self.source.send(support.cloud_message(scene))
                rate.sleep()
            last = self.source.send(support.cloud_message(scene))  # by which it is seen what came before
            self.detections.wait_for_stamp(last)
            _, _, values = self.wait_for("Detection", lambda s, v: int(v["processed"]) > 0 and self.counted(v) == sent + 1,
                                         "all %d accounted for" % (sent + 1))
            _, _, counts = self.wait_for("Input", lambda s, v: True, "the input")
            self.assertLessEqual(int(counts["of these lost on the way"]), int(counts["dropped for newer ones"]))
            self.assertGreater(int(values["processed"]), 10)

    def counted(self, detection):
        """Processed clouds, and those that the latest word on the input says were dropped."""
        dropped = [int(v.value) for m in self.diagnostics.messages for s in m.status for v in s.values
                   if v.key == "dropped for newer ones"]
        return int(detection["processed"]) + (dropped[-1] if dropped else 0)

    def test_unusable_clouds_are_an_error_for_a_while(self):
        with support.Node(parameters={"codebook": support.CODEBOOK}):
            self.detections.wait_for_stamp(self.source.send(support.cloud_message(np.full((4, 4, 3), np.nan))))
            values = self.wait_for("Detection", lambda s, v: s.level == DiagnosticStatus.ERROR and "NaN" in s.message,
                                   "the error")[2]
            self.assertEqual((values["unusable"], values["processed"]), ("1", "0"))
            self.diagnostics.clear()
            self.detections.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene())))
            self.wait_for("Detection", lambda s, v: s.level == DiagnosticStatus.OK and "ms (median)" in s.message,
                          "the end of the error")

    def test_state_and_last_error_follow_the_clouds(self):
        status = support.Recorder("/detector/status", Status)
        with support.Node(parameters={"codebook": support.CODEBOOK}):
            for _ in range(2):  # the second time the log says nothing
                self.detections.wait_for_stamp(self.source.send(support.cloud_message(np.full((4, 4, 3), np.nan))))
                status.wait_for(lambda s: s.state == Status.FAILING and "NaN" in s.last_error, "the failure")
                self.wait_for("State", lambda s, v: s.level == DiagnosticStatus.ERROR and "NaN" in v["last error"],
                              "the failure")
                status.clear()
                self.detections.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene())))
                status.wait_for(lambda s: s.state == Status.DETECTING and s.last_error == "", "the end of the failure")
                status.clear()
                self.diagnostics.clear()
        status.close()

    def test_an_error_goes_when_its_own_cause_is_gone(self):
        status = support.Recorder("/detector/status", Status)
        with support.Node(parameters={"codebook": support.CODEBOOK, "max_points": -1}):
            status.wait_for(lambda s: "max_points" in s.last_error, "the wrong parameter")
            self.detections.wait_for_stamp(self.source.send(support.cloud_message(np.full((4, 4, 3), np.nan))))
            status.wait_for(lambda s: "NaN" in s.last_error, "the failure")
            status.clear()
            self.detections.wait_for_stamp(self.source.send(support.cloud_message(synthetic.scene())))
            status.wait_for(lambda s: "max_points" in s.last_error, "what is still wrong")
            status.clear()
            client = dynamic_reconfigure.client.Client("/detector", timeout=support.PATIENCE)
            client.update_configuration({"max_points": 1000000})
            status.wait_for(lambda s: s.last_error == "", "no error")
            client.close()
        status.close()

    def test_a_topic_of_images_is_told_from_silence(self):
        images = rospy.Publisher("/pictures", Image, queue_size=1)
        with support.Node(parameters={"codebook": support.CODEBOOK, "silence_warning": 0.5},
                          arguments=["~points:=/pictures"]) as node:
            node.wait_for_output("no cloud on /pictures", "it is a topic of sensor_msgs/Image", "depth_images.launch")
            self.assertEqual(self.wait_for("Input", lambda s, v: "sensor_msgs/Image" in s.message, "it")[0],
                             DiagnosticStatus.WARN)
        images.unregister()

    def test_names_the_topics_of_clouds_where_nobody_publishes(self):
        with support.Node(parameters={"codebook": support.CODEBOOK, "silence_warning": 0.5},
                          arguments=["~points:=/nothing"]) as node:
            line = node.wait_for_output("no cloud on /nothing", "topics of clouds are", "/points")
            self.assertNotIn("/detector/keypoints", line)

    def test_tells_codebook_and_memory(self):
        with support.Node(parameters={"codebook": support.CODEBOOK}):
            level, message, values = self.wait_for("Codebook", lambda s, v: "synthetic (" in s.message, "the codebook")
            self.assertEqual(level, DiagnosticStatus.OK)
            self.assertEqual((values["file"], values["objects"]), (support.CODEBOOK, "2"))
            self.assertGreater(int(values["words"]), 50)
            memory = float(self.wait_for("Process", lambda s, v: True, "the process")[2]["resident memory [MB]"])
            self.assertTrue(10 < memory < 2000, memory)
            self.assertEqual(self.wait_for("State", lambda s, v: "detecting" in s.message, "the state")[2],
                             {"last error": "none"})

    def test_a_missing_codebook_is_an_error_that_says_what_to_do(self):
        with support.Node(parameters={"silence_warning": 0.5}):
            for part in ("Codebook", "State"):
                level, message, _ = self.wait_for(part, lambda s, v: "no codebook" in s.message, "the missing codebook")
                self.assertEqual(level, DiagnosticStatus.ERROR)
            self.assertIn("~load_codebook", self.wait_for("Codebook", lambda s, v: True, "it")[1])
            level, message, _ = self.wait_for("Input", lambda s, v: "no cloud on /points" in s.message, "the silence")
            self.assertEqual(level, DiagnosticStatus.WARN)


if __name__ == "__main__":
    rospy.init_node("diagnostics_test")
    rostest.rosrun("sks_detector", "diagnostics", DiagnosticsTest)
