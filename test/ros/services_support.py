# SPDX-License-Identifier: BSD-3-Clause
"""A detector whose services a test calls, in a process of its own that the test can restart."""
import os
import shutil
import signal
import subprocess
import tempfile
import threading
import unittest

import numpy as np
import rospy
import std_srvs.srv
import yaml

import support
import synthetic
from sks_detector import srv
from sks_detector.msg import Status

TYPES = {
    "train": srv.Train, "cancel_training": std_srvs.srv.Trigger, "load_codebook": srv.LoadCodebook,
    "save_codebook": srv.SaveCodebook, "capture_view": srv.CaptureView, "remove_object": srv.RemoveObject, "undo_capture": srv.UndoCapture,
    "detect": srv.Detect, "info": srv.Info, "enable": std_srvs.srv.SetBool,
}


class DetectorProcess:
    """detector_node as /detector, with clouds from /points and folders of its own."""

    def __init__(self, folder):
        self.codebooks = os.path.join(folder, "codebooks")
        self.datasets = os.path.join(folder, "datasets")
        rospy.set_param("/detector/codebook_directory", self.codebooks)
        rospy.set_param("/detector/dataset_directory", self.datasets)
        self.start()

    def start(self):
        self.process = subprocess.Popen(["rosrun", "sks_detector", "detector_node", "__name:=detector",
                                         "~points:=/points"])
        self.services = {name: rospy.ServiceProxy("/detector/" + name, kind) for name, kind in TYPES.items()}
        for service in self.services.values():
            service.wait_for_service(support.PATIENCE)

    def call(self, service, *arguments, **fields):
        return self.services[service](*arguments, **fields)

    def alive(self):
        return self.process.poll() is None

    def memory(self):
        """Resident [MB]."""
        return support.memory_of(self.process.pid)

    def handles(self):
        return len(os.listdir("/proc/%d/fd" % self.process.pid))

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self):
        """The exit status."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(support.PATIENCE)


class ServicesTest(unittest.TestCase):
    """Base of the tests of the services; each class has a detector and folders, which hold the shared test data."""

    @classmethod
    def setUpClass(cls):
        cls.folder = os.path.realpath(tempfile.mkdtemp(prefix="sks_services_"))
        shutil.copytree(support.DATA, os.path.join(cls.folder, "datasets"))
        os.mkdir(os.path.join(cls.folder, "codebooks"))
        shutil.copy(support.CODEBOOK, os.path.join(cls.folder, "codebooks"))
        cls.node = DetectorProcess(cls.folder)
        cls.status = support.Recorder("/detector/status", Status)
        cls.source = support.CloudSource("/points")

    @classmethod
    def tearDownClass(cls):
        status = cls.node.stop()
        shutil.rmtree(cls.folder)
        assert status == 0, "the node ended with status %d" % status

    def tearDown(self):
        self.assertTrue(self.node.alive())
        self.assertTrue(self.node.call("info").success)

    def succeed(self, service, *arguments, **fields):
        reply = self.node.call(service, *arguments, **fields)
        self.assertTrue(reply.success, reply.message)
        self.assertTrue(reply.message)
        return reply

    def refuse(self, service, *reasons, **fields):
        """Calls a service that is to fail, with all of the reasons in its message and in the status."""
        reply = self.node.call(service, **fields)
        self.assertFalse(reply.success, reply.message)
        for reason in reasons:
            self.assertIn(reason, reply.message)
        self.status.wait_for(lambda s: reply.message in s.last_error, "the error in the status")
        return reply

    def capture(self, points, name, colors=None, frame="camera"):
        """Calls the service, then publishes until it replies: it takes the next cloud."""
        replies = []
        call = threading.Thread(target=lambda: replies.append(self.node.call("capture_view", name, 30)))
        call.start()
        while call.is_alive():
            if self.source.publisher.get_num_connections() > 0:
                self.source.publisher.publish(support.cloud_message(points, frame, None, colors))
            call.join(0.05)
        return replies[0]

    def wait_for_status(self, condition, what):
        return support.wait_for(lambda: self.status.messages and condition(self.status.messages[-1]) and
                                self.status.messages[-1], what)

    def write_dataset(self, name, training, **fields):
        path = os.path.join(self.node.datasets, name)
        with open(path, "w") as file:
            yaml.safe_dump(dict({"name": os.path.splitext(name)[0], "units": "m", "training": training}, **fields), file)
        return path

    def write_slow_dataset(self, name="slow.yaml", views=1000):
        """One that takes many seconds with threads=1, cloud by cloud."""
        return self.write_dataset(name, [{"object": "thing", "cloud": "thing.pcd", "kind": "view"}] * views)


def standing(shape, x=0.0, z=0.85, turn=0.0):
    """A placement for tabletop(): a shape at a place on the table, turned about the vertical [degrees]."""
    lowest = max(center[1] + half[1] for _, center, half in shape)
    return shape, synthetic.pose(turn, (0, 1, 0), (x, 0.3 - lowest, z))


def tabletop(*placed, width=320, height=240, pixel=0.0025):
    """What a camera that looks down by 25 degrees sees of a table with things on it: organised."""
    table = ([(synthetic.BOX, (0, 0, 0), (0.45, 0.02, 0.4))], synthetic.pose(0, (0, 1, 0), (0, 0.32, 0.9)))
    tilt = synthetic.pose(25, (1, 0, 0), (0, 0, 0))
    return synthetic.view([(shape, tilt @ T) for shape, T in (table,) + placed], width, height, pixel)


def colors_of(points):
    """Some colours for a cloud."""
    return np.nan_to_num(points * 200 % 256).astype(np.uint8)
