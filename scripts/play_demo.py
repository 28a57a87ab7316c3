#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What demo.launch shows: simulates tables and trains the objects on them into the folder ~folder, unless they are there, lets
the detector load the codebook and plays the tables again and again."""
import os
import subprocess
import sys
import time

import roslib.packages
import rospy

from sks_detector.srv import LoadCodebook

CODEBOOK = "objects.sks"
WAIT_FOR_DETECTOR = 120.0  # [s]
SECONDS_PER_TABLE = 3
LONGEST_WORK = 1800  # of simulation and of training, on a slow machine [s]
LONGEST_END = 10.0  # of rosbag play [s]


def program(package, name):
    found = roslib.packages.find_node(package, name)
    if not found:
        raise RuntimeError("the program %s of the package %s is not installed" % (name, package))
    return found[0]


def run_unless_there(path, text, command):
    if os.path.exists(path):
        rospy.loginfo("%s is there", path)
        return
    rospy.loginfo("%s, which takes a while the first time", text)
    run = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                         timeout=LONGEST_WORK, universal_newlines=True)
    if rospy.is_shutdown():
        raise rospy.ROSInterruptException(text)
    if run.returncode != 0:
        raise RuntimeError("%s: status %d: %s" % (" ".join(command), run.returncode, run.stderr.strip()))


def load(detector):
    service = detector + "/load_codebook"
    rospy.wait_for_service(service, timeout=WAIT_FOR_DETECTOR)
    reply = rospy.ServiceProxy(service, LoadCodebook)(path=CODEBOOK)
    if not reply.success:
        raise RuntimeError("%s: %s" % (service, reply.message))
    rospy.loginfo("the detector looks for %s", ", ".join(reply.objects))


def play(bag):
    player = subprocess.Popen([program("rosbag", "play"), "--clock", "--quiet", "--delay", "1", bag],
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    while player.poll() is None and not rospy.is_shutdown():
        time.sleep(0.1)
    if player.poll() is None:
        player.terminate()
        player.wait(LONGEST_END)
    elif player.returncode != 0 and not rospy.is_shutdown():
        raise RuntimeError("rosbag play %s: status %d" % (bag, player.returncode))


def main():
    rospy.init_node("demo")
    folder = rospy.get_param("~folder")
    tables = os.path.join(folder, "tables")
    bag = os.path.join(tables, "scenes.bag")
    detector = rospy.resolve_name(rospy.get_param("~detector", "detector"))
    os.makedirs(folder, exist_ok=True)
    sks = program("sks_detector", "sks")
    run_unless_there(bag, "simulating tables",
                     [sks, "simulate", "--builtin", "--scenes", str(rospy.get_param("~tables", 3)), "--bag", "--rate",
                      str(1 / SECONDS_PER_TABLE), "--output", tables, "--force"])
    run_unless_there(os.path.join(folder, CODEBOOK), "training the objects",
                     [sks, "train", "--builtin", "--output", os.path.join(folder, CODEBOOK)])
    load(detector)
    rospy.loginfo("playing %s; rostopic echo %s/detections shows what is found", bag, detector)
    while not rospy.is_shutdown():
        play(bag)
        time.sleep(SECONDS_PER_TABLE)  # the last table is looked at as long as the others
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except rospy.ROSInterruptException:
        sys.exit(0)
    except (OSError, RuntimeError, rospy.ROSException, rospy.ServiceException, subprocess.TimeoutExpired) as error:
        sys.exit("demo: %s" % error)
