#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Storms of requests while frames flow, and codebook files that change under the node."""
import contextlib
import itertools
import os
import shutil
import socket
import subprocess
import threading
import unittest
import urllib.parse
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import rosgraph
import rospy
import rostest
from dynamic_reconfigure.msg import BoolParameter, Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure

import services_support
import support
import synthetic
from sks_detector.msg import DetectionArray


class Frames(threading.Thread):
    """Good clouds, one after the other: each is to be answered. Leave the `with` block to stop."""

    def __init__(self, source):
        super().__init__()
        self._source, self._going, self.answers, self._failure = source, True, [], None
        self._recorder = support.Recorder("/detector/detections", DetectionArray)

    def run(self):
        try:
            while self._going:
                stamp = self._source.send(support.cloud_message(synthetic.scene()))
                self.answers.append(self._recorder.wait_for_stamp(stamp))
        except AssertionError as error:
            self._failure = error

    def __enter__(self):
        self.start()
        support.wait_for(lambda: self.answers, "the first answer")
        return self

    def __exit__(self, kind, *_):
        self._going = False
        self.join()
        self._recorder.close()
        if not kind and self._failure:
            raise self._failure


def connect(connections, service, kind):
    """A persistent connection, for one thread, that an ExitStack closes when all calls are done: roscpp may lose a new
    connection while it closes an old one (docs/reliability.md)."""
    return connections.enter_context(contextlib.closing(rospy.ServiceProxy(service, kind, persistent=True)))


class FaultyServicesTest(services_support.ServicesTest):
    def setUp(self):
        self.file = os.path.join(self.node.codebooks, "replaced.sks")
        shutil.copy(support.CODEBOOK, self.file)
        self.loaded = self.succeed("load_codebook", "replaced.sks").codebook

    def expect_objects(self, objects, answer=None):
        found = answer or self.succeed("detect", cloud=support.cloud_message(synthetic.scene())).detections
        self.assertEqual(sorted(d.object for d in found.detections), objects)

    def calls(self):
        """Requests of all kinds, good and bad: name, fields and whether it is to succeed."""
        scene = support.cloud_message(synthetic.scene())
        unusable = support.cloud_message(np.full((4, 4, 3), np.nan))
        return [("info", {}, True), ("detect", {"cloud": scene}, True), ("detect", {"cloud": unusable}, False),
                ("enable", {"data": True}, True), ("save_codebook", {"path": "saved.sks", "overwrite": True}, True),
                ("save_codebook", {"path": "/etc/passwd"}, False), ("load_codebook", {"path": "replaced.sks"}, True),
                ("load_codebook", {"path": "missing.sks"}, False), ("remove_object", {"object": "nothing"}, False),
                ("cancel_training", {}, False), ("train", {"dataset": "missing.yaml"}, False),
                ("capture_view", {"object": "../thing", "timeout": 0.1}, False)]

    def storm(self, client):
        """100 clients at once and frames meanwhile; a client returns the replies to its calls, each with what was
        expected of it."""
        with Frames(self.source) as frames:
            before = len(frames.answers)
            with ThreadPoolExecutor(100) as pool:
                replies = list(itertools.chain.from_iterable(pool.map(client, range(100))))
            support.wait_for(lambda: len(frames.answers) > before + 3, "frames meanwhile")
        self.assertEqual(len(replies), 1000)
        for service, reply, good in replies:
            if "training" not in reply.message:  # one that is about to fail: it refuses others, or is cancelled
                self.assertEqual(reply.success, good, (service, reply.message))
                self.assertTrue(reply.message, service)
        for answer in frames.answers:
            self.expect_objects(["round", "thing"], answer)
        self.assertEqual(self.succeed("info").codebook, self.loaded)

    def test_a_thousand_calls_in_parallel_with_frames(self):
        calls = self.calls()

        def client(number):
            service, fields, good = calls[number % len(calls)]
            proxy = connect(connections, "/detector/" + service, services_support.TYPES[service])
            return [(service, proxy(**fields), good) for _ in range(10)]

        with contextlib.ExitStack() as connections:
            self.storm(client)

    def test_a_thousand_calls_over_connections_of_their_own(self):
        """roscpp loses some of these before the node sees them (docs/reliability.md): asked again, few and counted."""
        calls, lost = self.calls(), []

        def ask(service, fields):
            proxy = rospy.ServiceProxy("/detector/" + service, services_support.TYPES[service])
            try:
                return proxy(**fields)
            except rospy.ServiceException as error:
                self.assertIn("unable to receive data", str(error))
                lost.append(service)
                return proxy(**fields)

        def client(number):
            chosen = [calls[(10 * number + i) % len(calls)] for i in range(10)]
            return [(service, ask(service, fields), good) for service, fields, good in chosen]

        self.storm(client)
        self.assertLessEqual(len(lost), 10)

    def test_a_storm_of_reconfigurations(self):
        """Good sets and bad ones from many sides: what is in force, told and on the parameter server is one."""
        def parameters(number):
            wrong = number % 3 == 0
            return Config(doubles=[DoubleParameter("keypoints.discard", 5.0 if wrong else 0.1 + 0.1 * (number % 5)),
                                   DoubleParameter("tf_timeout", 1.0 + number % 7)],
                          bools=[BoolParameter("always_on", number % 2 == 0)])

        def client(first):
            proxy = connect(connections, "/detector/set_parameters", Reconfigure)
            configs = [proxy(parameters(number)).config for number in range(first, 500, 20)]
            return [{d.name: d.value for d in config.doubles} for config in configs]

        with contextlib.ExitStack() as connections, Frames(self.source) as frames:
            with ThreadPoolExecutor(20) as pool:
                replies = list(itertools.chain.from_iterable(pool.map(client, range(20))))
            before = len(frames.answers)
            support.wait_for(lambda: len(frames.answers) > before + 3, "frames afterwards")
        self.assertEqual(len(replies), 500)
        pairs = {(round(r["keypoints.discard"], 3), r["tf_timeout"]) for r in replies}
        asked = {(round(d[0].value, 3), d[1].value) for d in (parameters(n).doubles for n in range(500))}
        self.assertLessEqual(pairs - {(0.35, 0.2)}, asked, "no mixture of two sets, nor a refused one")
        config = rospy.ServiceProxy("/detector/set_parameters", Reconfigure)(parameters(1)).config
        last = {d.name: d.value for d in config.doubles}
        self.assertEqual(rospy.get_param("/detector/keypoints/discard"), last["keypoints.discard"])
        self.assertEqual(rospy.get_param("/detector/tf_timeout"), last["tf_timeout"])
        for answer in frames.answers:
            self.assertEqual(len(answer.detections), 2)

    def test_a_codebook_file_that_changes_while_it_is_loaded(self):
        with open(support.CODEBOOK, "rb") as file:
            content = file.read()
        for broken in (b"", content[:len(content) // 2], content[:-1], b"\0" * len(content), b"\xff" * 100):
            with open(self.file, "wb") as file:  # in place, not as a new file
                file.write(broken)
            self.refuse("load_codebook", "replaced.sks", path="replaced.sks")
            self.assertEqual(self.succeed("info").codebook, self.loaded)
            self.expect_objects(["round", "thing"])
        os.remove(self.file)
        self.expect_objects(["round", "thing"])
        self.refuse("load_codebook", "replaced.sks", "No such file", path="replaced.sks")
        self.train(self.file)
        self.expect_objects(["round", "thing"])
        self.assertNotEqual(self.succeed("load_codebook", "replaced.sks").codebook, self.loaded)
        self.expect_objects(["thing"])

    def test_a_codebook_file_that_is_replaced_while_it_is_in_use(self):
        """As a whole, again and again, by another process; frames see the one or the other."""
        one = os.path.join(self.node.codebooks, "one.sks")
        self.train(one)
        known = {self.loaded: ["round", "thing"], self.succeed("load_codebook", "one.sks").codebook: ["thing"]}
        going = threading.Event()
        going.set()

        def replace():
            for source in itertools.cycle((one, support.CODEBOOK)):
                shutil.copy(source, self.file + ".new")
                os.replace(self.file + ".new", self.file)
                if not going.is_set():
                    break

        writer = threading.Thread(target=replace)
        with Frames(self.source) as frames:
            writer.start()
            try:
                replies = [self.succeed("load_codebook", "replaced.sks") for _ in range(200)]
                answers = len(frames.answers)
                support.wait_for(lambda: len(frames.answers) > answers + 3, "frames afterwards")
            finally:
                going.clear()
                writer.join()
        self.assertEqual({reply.codebook for reply in replies}, set(known))
        for reply in replies:
            self.assertEqual(sorted(reply.objects), known[reply.codebook])
        for answer in frames.answers:
            self.expect_objects(known[answer.codebook], answer)

    def train(self, file):
        subprocess.check_call(["rosrun", "sks_detector", "sks", "train", "--dataset", self.dataset_of("thing"),
                               "--output", file], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def dataset_of(self, name):
        return self.write_dataset("one.yaml", [{"object": name, "cloud": name + ".pcd", "kind": "view"}])

    def test_swaps_of_the_codebook_take_no_more_memory(self):
        def swap(times):
            for _ in range(times):
                self.succeed("load_codebook", "replaced.sks")
                self.expect_objects(["round", "thing"])
            return self.node.memory()
        before = swap(50)
        self.assertLess(swap(200) - before, 20)

    def test_hundreds_of_connections_that_say_nothing(self):
        """Half-open ones, to both ports of the node: others are served meanwhile, and all are let go in the end."""
        master = rosgraph.Master("/faults_services_test")
        ports = [urllib.parse.urlparse(uri).port for uri in
                 (master.lookupNode("/detector"), master.lookupService("/detector/info"))]
        before = self.node.handles()
        with contextlib.ExitStack() as connections:
            for number in range(400):
                connection = connections.enter_context(socket.create_connection(("localhost", ports[number % 2])))
                connection.send((b"", b"P", b"POST / HTTP/1.0\r\n", b"\x10")[number // 2 % 4])
            with Frames(self.source) as frames:
                for _ in range(20):
                    self.assertEqual(self.succeed("info").codebook, self.loaded)
                answers = len(frames.answers)
                support.wait_for(lambda: len(frames.answers) > answers + 3, "frames meanwhile")
        support.wait_for(lambda: self.node.handles() < before + 50, "the end of the connections")
        self.expect_objects(["round", "thing"])

    def test_a_codebook_file_that_is_written_while_it_is_read(self):
        with open(support.CODEBOOK, "rb") as file:
            content = file.read()
        going = threading.Event()
        going.set()

        def write():
            while going.is_set():
                with open(self.file, "wb") as file:
                    file.write(content)

        writer = threading.Thread(target=write)
        writer.start()
        try:
            replies = [self.node.call("load_codebook", path="replaced.sks") for _ in range(300)]
        finally:
            going.clear()
            writer.join()
        for reply in replies:
            self.assertTrue(reply.success or "replaced.sks" in reply.message, reply.message)
        self.assertTrue(any(reply.success for reply in replies))
        self.expect_objects(["round", "thing"])


if __name__ == "__main__":
    rospy.init_node("faults_services_test")
    rostest.rosrun("sks_detector", "faults_services", FaultyServicesTest)
