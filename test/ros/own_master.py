# SPDX-License-Identifier: BSD-3-Clause
"""A master of the test's own, which it may end, and calls that need none."""
import os
import signal
import socket
import subprocess
import threading

import rosgraph
import rospy

import support


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


class Master:
    """Is where this process, and those that it starts, look for it from then on."""

    def __init__(self):
        self._port = free_port()
        os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % self._port
        self.start()

    def start(self):
        self._process = subprocess.Popen(["rosmaster", "--core", "-p", str(self._port)], stdout=subprocess.DEVNULL)
        support.wait_for(rosgraph.is_master_online, "the master")

    def kill(self):
        self._process.kill()
        self._process.wait()

    def stand_still(self):
        self._process.send_signal(signal.SIGSTOP)

    def go_on(self):
        self._process.send_signal(signal.SIGCONT)


def service(name, service_type, patience=support.PATIENCE):
    """Connected for good: no call asks a master where the node is. A call that does not return fails the test."""
    proxy = rospy.ServiceProxy("/detector/" + name, service_type, persistent=True)
    proxy.wait_for_service(support.PATIENCE)

    def call(*arguments, **fields):
        replies = []
        threading.Thread(target=lambda: replies.append(proxy(*arguments, **fields)), daemon=True).start()
        return support.wait_for(lambda: replies, "the reply of " + name, patience)[0]
    return call
