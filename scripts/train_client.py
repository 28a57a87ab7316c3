#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Calls the service ~train of a running detector with what its private parameters say, and tells the progress."""
import sys

import rospy

from sks_detector.msg import Status
from sks_detector.srv import Train


class Progress:
    """Logs what the detector is at, a line for each tenth of the way."""

    def __init__(self, topic):
        self._tenth = 0
        rospy.Subscriber(topic, Status, self._receive)

    def _receive(self, status):
        tenth = int(10 * status.progress_fraction)
        if status.progress and tenth != self._tenth:
            rospy.loginfo("%3d %%: %s", 100 * status.progress_fraction, status.progress)
        self._tenth = tenth


def main():
    rospy.init_node("train")
    detector = rospy.resolve_name(rospy.get_param("~detector", "detector"))
    rospy.loginfo("waiting for %s/train", detector)
    rospy.wait_for_service(detector + "/train")
    Progress(detector + "/status")
    reply = rospy.ServiceProxy(detector + "/train", Train)(
        dataset=rospy.get_param("~dataset", ""), captured=rospy.get_param("~captured", False),
        name=rospy.get_param("~name", ""), output=rospy.get_param("~output", ""),
        overwrite=rospy.get_param("~overwrite", False))
    (rospy.loginfo if reply.success else rospy.logerr)(reply.message)
    return 0 if reply.success else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (rospy.ROSInterruptException, rospy.ServiceException) as error:
        sys.exit(str(error))
