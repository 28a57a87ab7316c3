#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Prints name, score and position of what the detector node finds on /detector/detections.
# Nothing to build; run: rosrun sks_detector ros_subscriber.py, or python3 examples/ros_subscriber.py
import rospy
from sks_detector.msg import DetectionArray


def show(found):
    for detection in found.detections:
        p = detection.box_center.position
        print("%s, score %.2f, at %.3f %.3f %.3f m in %s"
              % (detection.object, detection.score, p.x, p.y, p.z, found.header.frame_id), flush=True)


if __name__ == "__main__":
    rospy.init_node("subscriber")
    rospy.Subscriber("/detector/detections", DetectionArray, show, queue_size=10)
    rospy.spin()
