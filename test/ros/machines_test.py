#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A master and two machines with a camera and a detector each, which are network namespaces here: detections cross the
network, clouds do not, and one machine goes on when the other is gone.

Needs root and `ip`: exit status 77 without. The test with <machine> tags also needs sshd, and is skipped where that is missing.

All of it runs in namespaces of its own: of the network, so that this process is on the master's machine; of mounts, with files
only in a /run of its own; and of processes. The kernel ends and removes all that is in them with their first process, which ends
with this one, however it does."""
import contextlib
import importlib.util
import os
import shlex
import shutil
import signal
import subprocess
import sys
import unittest

import numpy as np
import rosgraph
import rospy
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage

import support
import synthetic
from sks_detector.msg import DetectionArray

SSHD = shutil.which("sshd", path="/usr/sbin:/usr/local/sbin:" + os.environ["PATH"])
MASTER = "10.77.0.1"
FOLDER = "/run"

# What each machine with a camera has; its address, and the object before its camera.
MACHINES = {"left": ("10.77.0.2", "thing"), "right": ("10.77.0.3", "round")}

# A camera and its detector, in a namespace of topics.
SIDE = """
  <group ns="{name}">
    <node pkg="sks_detector" type="cloud_camera.py" name="camera" machine="{machine}" output="screen">
      <param name="object" value="{object}"/>
      <param name="frame" value="{name}_camera"/>
    </node>
    <include file="$(find sks_detector)/launch/detector.launch">
      <arg name="machine" value="{machine}"/>
      <arg name="points" value="/{name}/camera/points"/>
      <arg name="codebook" value="~/objects.sks"/>
      <arg name="publish_tf" value="true"/>
      <arg name="tf_prefix" value="{name}"/>
    </include>
    <param name="detector/threads" value="1"/>
  </group>"""
MACHINE = '<machine name="{name}" address="{address}" env-loader="{folder}/env.sh" user="root" timeout="60"/>'

SSHD_CONFIG = """
ListenAddress {address}
HostKey /run/ssh/host_key
AuthorizedKeysFile /run/ssh/key.pub
StrictModes no
PermitRootLogin yes
PasswordAuthentication no
UsePAM no
PidFile none
"""


def call(*command):
    """Its output; explains itself where it fails."""
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                         timeout=support.PATIENCE)
    if run.returncode != 0:
        raise OSError("%s: %s" % (" ".join(command), run.stdout.strip()))
    return run.stdout


def write(path, text):
    with open(path, "w") as file:
        file.write(text)


def home(name):
    return os.path.join(FOLDER, "homes", name)


def make_network():
    """This process is on the master's machine; the others are joined with it by a bridge."""
    call("mount", "-t", "tmpfs", "-o", "mode=755", "none", FOLDER)
    call("ip", "link", "set", "lo", "up")
    call("ip", "link", "add", "name", "bridge", "type", "bridge")
    call("ip", "address", "add", MASTER + "/24", "dev", "bridge")
    call("ip", "link", "set", "bridge", "up")
    for name, (address, _) in MACHINES.items():
        call("ip", "netns", "add", name)
        call("ip", "link", "add", "name", name, "type", "veth", "peer", "name", "eth0", "netns", name)
        call("ip", "link", "set", name, "master", "bridge", "up")
        call("ip", "-n", name, "link", "set", "lo", "up")
        call("ip", "-n", name, "address", "add", address + "/24", "dev", "eth0")
        call("ip", "-n", name, "link", "set", "eth0", "up")


def make_homes():
    """Each machine has its files in a folder of its own; the codebook is not on the master's."""
    os.makedirs(home("master"))
    variables = {key: value for key, value in os.environ.items() if key != "ROS_MASTER_URI"}
    for name, (address, _) in MACHINES.items():
        os.makedirs(home(name))
        shutil.copy(support.CODEBOOK, home(name) + "/objects.sks")
        variables.update(HOME=home(name), ROS_HOME=home(name), ROS_IP=address)
        write(home(name) + "/env.sh", "#!/bin/sh\n%s\nexec \"$@\"\n" % "\n".join(
            "export %s=%s" % (key, shlex.quote(value)) for key, value in variables.items() if key.isidentifier()))
        os.chmod(home(name) + "/env.sh", 0o755)
    os.environ.update(HOME=home("master"), ROS_HOME=home("master"), ROS_IP=MASTER,
                      ROS_MASTER_URI="http://%s:11311" % MASTER)


def start_sshd():
    """On both machines, with keys of their own."""
    os.makedirs("/run/sshd")  # where it wants to be empty
    os.makedirs("/run/ssh")
    os.makedirs(home("master") + "/.ssh", 0o700)
    for key in ("host_key", "key"):
        call("ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", "/run/ssh/" + key)
    os.rename("/run/ssh/key", home("master") + "/.ssh/id_ed25519")
    with open("/run/ssh/host_key.pub") as file:
        host_key = " ".join(file.read().split()[:2])
    addresses = ",".join(address for address, _ in MACHINES.values())
    write(home("master") + "/.ssh/known_hosts", "%s %s\n" % (addresses, host_key))
    for name, (address, _) in MACHINES.items():
        config = home(name) + "/sshd_config"
        write(config, SSHD_CONFIG.format(address=address))
        call("ip", "netns", "exec", name, SSHD, "-f", config, "-E", home(name) + "/sshd.log")


def processes(name):
    return [int(process) for process in call("ip", "netns", "pids", name).split()]


def programs(name):
    """The command lines of what runs on a machine, without sshd."""
    found = []
    for process in processes(name):
        with contextlib.suppress(OSError), open("/proc/%d/cmdline" % process) as file:
            found.append(file.read().replace("\0", " "))
    return [program for program in found if program and "sshd" not in program]


def kill(name):
    for process in processes(name):
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


def bytes_on_the_network():
    """Sent and received so far by both machines with cameras."""
    total = 0
    with open("/proc/net/dev") as file:
        for line in file:
            name, _, numbers = line.partition(":")
            if name.strip() in MACHINES:
                total += int(numbers.split()[0]) + int(numbers.split()[8])
    return total


class MachinesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.core = subprocess.Popen(["roscore"], stdout=subprocess.DEVNULL)
        support.wait_for(rosgraph.is_master_online, "the master")
        rospy.init_node("machines_test", disable_signals=True)
        cls.detections = {name: support.Recorder("/%s/detector/detections" % name, DetectionArray) for name in MACHINES}
        cls.transforms = support.Recorder("/tf", TFMessage)

    @classmethod
    def tearDownClass(cls):
        rospy.signal_shutdown("done")
        cls.core.send_signal(signal.SIGINT)
        cls.core.wait(support.PATIENCE)

    def setUp(self):
        for recorder in self.detections.values():
            recorder.clear()
        self.transforms.clear()
        for name in MACHINES:
            self.addCleanup(kill, name)

    def launch(self, name, text, *prefix):
        """roslaunch with a file of this text."""
        path = os.path.join(FOLDER, name + ".launch")
        write(path, "<launch>%s\n</launch>\n" % text)
        process = subprocess.Popen([*prefix, "roslaunch", path])
        self.addCleanup(process.wait, support.PATIENCE)
        self.addCleanup(process.kill)
        return process

    def end(self, process):
        """As Ctrl-C does."""
        process.send_signal(signal.SIGINT)
        process.wait(support.PATIENCE)

    def answers(self, name, count=3):
        """The next ones, received here: each with the object before this camera."""
        recorder, expected = self.detections[name], MACHINES[name][1]
        recorder.clear()
        answers = support.wait_for(lambda: len(recorder.messages) >= count and recorder.messages,
                                   "%d answers of %s" % (count, name))
        for answer in answers:
            self.assertEqual(answer.header.frame_id, name + "_camera")
            self.assertEqual([d.object for d in answer.detections], [expected])
            np.testing.assert_allclose(support.position_of(answer.detections[0].box_center), synthetic.position(expected),
                                       atol=0.01)
        return answers

    def expect_both_to_start(self):
        for name, recorder in self.detections.items():
            recorder.wait_for(lambda m: m.detections, "the first detection")
            self.answers(name)

    def expect_frames_of_their_own(self):
        for name, (_, thing) in MACHINES.items():
            found = self.transforms.wait_for(
                lambda m: m.transforms and m.transforms[0].header.frame_id == name + "_camera", "a frame of " + name)
            self.assertEqual([t.child_frame_id for t in found.transforms], ["%s/%s" % (name, thing)])

    def expect_no_clouds_on_the_network(self):
        before = bytes_on_the_network()
        answered = sum(len(self.answers(name, 10)) for name in MACHINES)
        moved = bytes_on_the_network() - before
        cloud = len(support.cloud_message(synthetic.scene()).data)
        print("%d clouds of %d bytes were answered; %d bytes were on the network" % (answered, cloud, moved))
        self.assertGreater(moved, 0)
        self.assertLess(moved, 0.1 * answered * cloud)
        before = bytes_on_the_network()
        rospy.wait_for_message("/left/camera/points", PointCloud2, support.PATIENCE)  # who asks for clouds gets them
        self.assertGreater(bytes_on_the_network() - before, cloud)

    def expect_right_to_go_on_without_left(self):
        self.answers("right")
        self.detections["left"].clear()
        self.answers("right", 5)
        self.assertEqual(self.detections["left"].messages, [])

    def expect_no_programs(self, *names):
        for name in names:
            support.wait_for(lambda: not programs(name), "the end of all programs on " + name)

    def test_each_machine_starts_its_own(self):
        launched = []
        for name, (_, thing) in MACHINES.items():
            launched.append(self.launch(name, SIDE.format(name=name, machine="", object=thing), "ip", "netns", "exec", name,
                                        home(name) + "/env.sh"))
        self.expect_both_to_start()
        self.expect_frames_of_their_own()
        self.expect_no_clouds_on_the_network()
        kill("left")
        self.expect_right_to_go_on_without_left()
        for process in launched:
            self.end(process)
        self.expect_no_programs(*MACHINES)

    @unittest.skipUnless(SSHD, "there is no sshd: apt-get install openssh-server")
    @unittest.skipUnless(importlib.util.find_spec("paramiko"), "there is no paramiko: apt-get install python3-paramiko")
    def test_one_launch_file_with_machine_tags(self):
        start_sshd()
        text = ""
        for name, (address, thing) in MACHINES.items():
            text += MACHINE.format(name=name, address=address, folder=home(name))
            text += SIDE.format(name=name, machine=name, object=thing)
        launched = self.launch("both", text)
        self.expect_both_to_start()
        for name in MACHINES:
            self.assertTrue(any("nodelet_manager" in program for program in programs(name)))
        self.expect_frames_of_their_own()
        self.expect_no_clouds_on_the_network()
        call("ip", "link", "set", "left", "down")  # the cable is pulled, and put back
        self.expect_right_to_go_on_without_left()
        call("ip", "link", "set", "left", "up")
        self.answers("left")
        kill("left")
        self.expect_right_to_go_on_without_left()
        self.end(launched)
        self.expect_no_programs(*MACHINES)


def run_in_namespaces():
    """This file once more, in namespaces of its own; the exit status."""
    command = ["unshare", "--net", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
    if os.geteuid() != 0:
        print("needs root, to make network namespaces")
        return 77
    for program in ("unshare", "setpriv", "ip"):
        if shutil.which(program) is None:
            print("there is no %s: apt-get install iproute2 util-linux" % program)
            return 77
    try:
        call(*command, "true")
    except OSError as error:
        print("needs namespaces of its own, which are refused here, as in many containers:", error)
        return 77
    return subprocess.call(["setpriv", "--pdeathsig", "KILL", *command, sys.executable, os.path.realpath(__file__), "inside",
                            *sys.argv[1:]])


if __name__ == "__main__":
    if sys.argv[1:2] != ["inside"]:
        sys.exit(run_in_namespaces())
    try:
        make_network()
    except OSError as error:
        print("cannot make machines of network namespaces here:", error)
        sys.exit(77)
    make_homes()
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], warnings="ignore")  # those of rospy
