#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Nodelets in a manager: they subscribe only while somebody listens, stand side by side, and go without a trace."""
import os
import signal
import subprocess
import time
import unittest

import rosnode
import rospy
import rostest
from nodelet.srv import NodeletList, NodeletLoad, NodeletLoadRequest, NodeletUnload
from visualization_msgs.msg import Marker, MarkerArray

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


CYCLES = 5 * int(os.environ.get("SKS_FAULT_RUNS", 4))  # of loading and unloading
OURS = ["sks_detector", "nodelet_manager"]
NODELETS = ["nodelet", "nodelet", "manager"]


def run(*command):
    """A process whose output is kept."""
    return subprocess.Popen(["rosrun", *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            universal_newlines=True)


class Manager:
    """A nodelet manager in a process of its own."""

    def __init__(self, name, command=OURS):
        self.name = name
        self.process = run(*command, "__name:=" + name)
        self._load = self._service("load_nodelet", NodeletLoad)
        self._unload = self._service("unload_nodelet", NodeletUnload)
        self._list = self._service("list", NodeletList)

    def _service(self, name, service_type):
        service = rospy.ServiceProxy("/%s/%s" % (self.name, name), service_type)
        service.wait_for_service(support.PATIENCE)
        return service

    def load(self, name, points="/points"):
        rospy.set_param("/%s/codebook" % name, support.CODEBOOK)
        request = NodeletLoadRequest(name="/" + name, type="sks_detector/DetectorNodelet",
                                     remap_source_args=["/%s/points" % name], remap_target_args=[points])
        assert self._load(request).success

    def unload(self, name):
        assert self._unload("/" + name).success

    def nodelets(self):
        return self._list().nodelets

    def end(self, how=signal.SIGINT):
        """Exit status and output."""
        self.process.send_signal(how)
        output, _ = self.process.communicate(timeout=support.PATIENCE)
        return self.process.returncode, output


class ManagerTest(unittest.TestCase):
    def setUp(self):
        self.manager = Manager("nodelets")
        self.source = support.CloudSource("/points")

    def tearDown(self):
        if self.manager.process.poll() is None:
            self.manager.end()
        self.source.publisher.unregister()

    def expect_answer(self, detections):
        answer = support.answer(self.source, support.cloud_message(synthetic.scene()), detections)
        self.assertEqual(len(answer.detections), 2)

    def expect_clean_end(self, how=signal.SIGINT):
        status, output = self.manager.end(how)
        self.assertEqual(status, 0, output)
        self.expect_no_trouble(output)

    def expect_no_trouble(self, output):
        for word in ("terminate", "abort", "egmentation", "boost::"):
            self.assertNotIn(word, output)

    def test_subscribes_only_while_somebody_listens(self):
        self.manager.load("detector")
        status = support.Recorder("/detector/status", Status)

        def wait_for_state(state):
            support.wait_for(lambda: status.messages and status.messages[-1].state == state, "the state %d" % state)

        wait_for_state(Status.READY)
        subscribers = self.source.publisher.get_num_connections
        time.sleep(1)  # what is not to happen cannot be waited for
        self.assertEqual(subscribers(), 0)
        for topic, message_type in (("detections", DetectionArray), ("markers", MarkerArray)):
            listener = support.Recorder("/detector/" + topic, message_type)
            support.wait_for(lambda: subscribers() == 1, "the subscription")
            wait_for_state(Status.DETECTING)
            listener.close()
            support.wait_for(lambda: subscribers() == 0, "the end of the subscription")
            wait_for_state(Status.READY)
        status.close()
        self.expect_clean_end()

    def test_two_detectors_stand_side_by_side(self):
        self.manager.load("left")
        self.manager.load("right")
        answers = [support.Recorder("/%s/detections" % name, DetectionArray) for name in ("left", "right")]
        support.wait_for(lambda: self.source.publisher.get_num_connections() > 0, "the subscription")
        support.wait_for(lambda: all(a.connections() for a in answers), "the connections")
        for answers_of_one in answers:
            self.expect_answer(answers_of_one)
        self.manager.unload("left")
        self.assertEqual(self.manager.nodelets(), ["/right"])
        self.expect_answer(answers[1])
        for answer in answers:
            answer.close()
        self.expect_clean_end()

    def expect_cleared_markers(self, when):
        self.manager.load("detector")
        markers = support.Recorder("/detector/markers", MarkerArray)
        detections = support.Recorder("/detector/detections", DetectionArray)
        self.expect_answer(detections)
        detections.close()
        shown = markers.wait_for(lambda m: len(m.markers) == 7)
        self.assertTrue(all(0 < m.lifetime.to_sec() <= 5 for m in shown.markers[1:]), "they stay if the node is killed")
        when()
        support.wait_for(lambda: [m.action for m in markers.messages[-1].markers] == [Marker.DELETEALL], "the clearing")
        markers.close()

    def test_clears_its_markers_when_it_is_unloaded(self):
        self.expect_cleared_markers(lambda: self.manager.unload("detector"))
        self.expect_clean_end()

    def test_clears_its_markers_when_the_manager_is_interrupted(self):
        self.expect_cleared_markers(self.expect_clean_end)

    def test_ends_cleanly_while_clouds_flow(self):
        self.manager.load("detector")
        detections = support.Recorder("/detector/detections", DetectionArray)
        self.expect_answer(detections)
        for _ in range(5):
            self.source.publisher.publish(support.cloud_message(synthetic.scene()))
        self.expect_clean_end()
        detections.close()

    def test_ends_cleanly_while_a_detector_starts(self):
        for delay in (0, 0.05, 0.2):
            self.manager.load("detector")
            time.sleep(delay)
            self.expect_clean_end()
            self.manager = Manager("nodelets")
        self.expect_clean_end()

    def test_unloads_a_detector_that_starts(self):
        self.manager.load("detector")
        self.manager.unload("detector")
        self.assertEqual(self.manager.nodelets(), [])
        self.expect_clean_end()

    def test_loads_and_unloads_leave_nothing_behind(self):
        def cycles(count):
            for _ in range(count):
                self.manager.load("detector")
                self.manager.unload("detector")
            self.assertEqual(self.manager.nodelets(), [])
            return self.manager.process.pid
        process = cycles(5)
        memory, threads = support.memory_of(process), support.threads_of(process)
        cycles(CYCLES)
        self.assertLess(support.memory_of(process) - memory, 10 + 0.1 * CYCLES)
        support.wait_for(lambda: support.threads_of(process) <= threads, "the end of the threads")
        self.manager.load("detector")
        detections = support.Recorder("/detector/detections", DetectionArray)
        self.expect_answer(detections)
        detections.close()
        self.expect_clean_end()

    def test_ends_cleanly_whenever_it_is_interrupted(self):
        """Together with `nodelet load`, as by Ctrl-C in a launch."""
        self.manager.end()
        rospy.set_param("/detector/codebook", support.CODEBOOK)
        for delay in (0.1, 0.25, 0.4, 0.55, 0.7, 0.9, 1.2):
            self.manager = Manager("nodelets")
            loader = run("nodelet", "nodelet", "load", "sks_detector/DetectorNodelet", "nodelets", "__name:=detector")
            time.sleep(delay)  # the moment is what is tested
            loader.send_signal(signal.SIGINT)
            self.expect_clean_end()
            self.expect_no_trouble(loader.communicate(timeout=support.PATIENCE)[0])

    def test_ends_cleanly_when_it_is_terminated(self):
        self.manager.load("detector")
        self.expect_clean_end(signal.SIGTERM)

    def test_ends_cleanly_by_rosnode_kill(self):
        self.manager.load("detector")
        self.assertEqual(rosnode.kill_nodes(["/nodelets"])[0], ["/nodelets"])
        output, _ = self.manager.process.communicate(timeout=support.PATIENCE)
        self.assertEqual(self.manager.process.returncode, 0, output)
        self.expect_no_trouble(output)

    def test_ends_cleanly_in_the_manager_of_the_package_nodelet(self):
        self.manager.end()
        self.manager = Manager("nodelets", NODELETS)
        self.test_ends_cleanly_while_clouds_flow()

    def test_detector_node_ends_cleanly_when_it_is_terminated(self):
        node = support.Node("terminated", {"codebook": support.CODEBOOK})
        detections = support.Recorder("/terminated/detections", DetectionArray)
        self.expect_answer(detections)
        status = node.stop(signal.SIGTERM)
        self.assertEqual(status, 0, node.output())
        self.expect_no_trouble(node.output())
        self.assertNotIn("/terminated", rosnode.get_node_names())
        detections.close()


if __name__ == "__main__":
    rospy.init_node("manager_test")
    rostest.rosrun("sks_detector", "manager", ManagerTest)
