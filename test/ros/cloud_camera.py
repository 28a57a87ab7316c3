#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A node in place of a camera: publishes one cloud of an object of synthetic.py again and again. Parameters: object, frame."""
import rospy

import support
import synthetic

if __name__ == "__main__":
    rospy.init_node("camera")
    source = support.CloudSource("~points", queue_size=1)
    cloud = support.cloud_message(synthetic.scene([rospy.get_param("~object")]), rospy.get_param("~frame"))
    rate = rospy.Rate(5)
    while not rospy.is_shutdown():
        cloud.header.stamp = rospy.Time.now()
        source.publisher.publish(cloud)
        try:
            rate.sleep()
        except rospy.ROSInterruptException:
            break
