#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what a training costs the frames: latencies (stamp of the cloud to the receipt of its detections) of a running
detector without and during calls of its service ~train, in turns. Only a training with the result that is in use already compares
like with like: train the data set once before. Clouds flow from a camera or a bag, or are published here from a file."""
import argparse
import os
import sys
import threading

import numpy as np
import rospy
from sensor_msgs.msg import PointCloud2, PointField

from sks_detector.msg import DetectionArray
from sks_detector.srv import Train


class Latencies:
    """Of the detections that arrive, in ms, with the names of their codebooks."""

    def __init__(self, topic):
        self._lock = threading.Lock()
        self._seen = []
        rospy.Subscriber(topic, DetectionArray, self._receive)

    def _receive(self, message):
        with self._lock:
            self._seen.append((1000 * (rospy.Time.now() - message.header.stamp).to_sec(), message.codebook))

    def take(self):
        """Those since the last call."""
        with self._lock:
            seen, self._seen = self._seen, []
        return seen


def read_pcd(path):
    """A binary PCD file of four-byte fields as a message."""
    with open(path, "rb") as file:
        header = {}
        while "DATA" not in header:
            words = file.readline().decode("ascii").split()
            header[words[0]] = words[1:]
        if header["DATA"] != ["binary"] or set(header["SIZE"]) != {"4"}:
            sys.exit("%s: only binary PCD files of four-byte fields can be published; convert it: "
                     "pcl_convert_pcd_ascii_binary in.pcd out.pcd 1" % path)
        data = file.read()
    cloud = PointCloud2(height=int(header["HEIGHT"][0]), width=int(header["WIDTH"][0]))
    types = {"F": PointField.FLOAT32, "U": PointField.UINT32, "I": PointField.INT32}
    cloud.fields = [PointField(name, 4 * i, types[kind], 1)
                    for i, (name, kind) in enumerate(zip(header["FIELDS"], header["TYPE"]))]
    cloud.point_step = 4 * len(cloud.fields)
    cloud.row_step = cloud.point_step * cloud.width
    cloud.data = np.frombuffer(data, np.uint8, cloud.row_step * cloud.height).tobytes()
    cloud.header.frame_id = "camera"
    return cloud


def publish(cloud, topic, period):
    publisher = rospy.Publisher(topic, PointCloud2, queue_size=1)

    def send(_):
        cloud.header.stamp = rospy.Time.now()
        publisher.publish(cloud)
    return rospy.Timer(rospy.Duration(period), send)


def summary(name, seen):
    """Median, 95 % and maximum [ms]."""
    milliseconds = sorted(latency for latency, _ in seen)
    middle, p95 = milliseconds[len(milliseconds) // 2], milliseconds[int(0.95 * (len(milliseconds) - 1))]
    print("%-8s %4d frames: mean %6.1f  p50 %6.1f  p95 %6.1f  max %6.1f ms; codebooks %s" % (
        name, len(seen), sum(milliseconds) / len(seen), middle, p95, milliseconds[-1],
        ", ".join(sorted({codebook for _, codebook in seen}))))
    return middle, p95, milliseconds[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--detector", default="/detector", help="name of the node (default: %(default)s)")
    parser.add_argument("--dataset", required=True, help="data set file in its ~dataset_directory")
    parser.add_argument("--seconds", type=float, default=10, help="of measuring without training, each turn (default: %(default)s)")
    parser.add_argument("--repeat", type=int, default=5, help="turns (default: %(default)s)")
    parser.add_argument("--cloud", help="PCD file to publish")
    parser.add_argument("--points", default="/points", help="topic to publish it on (default: %(default)s)")
    parser.add_argument("--period", type=float, default=0.5, help="of publishing [s] (default: %(default)s)")
    arguments = parser.parse_args(rospy.myargv()[1:])

    rospy.init_node("measure_training", anonymous=True)
    train = rospy.ServiceProxy(arguments.detector + "/train", Train)
    train.wait_for_service(30)
    latencies = Latencies(arguments.detector + "/detections")
    if arguments.cloud:
        publish(read_pcd(arguments.cloud), arguments.points, arguments.period)
    rospy.sleep(3)
    without, during = [], []
    for _ in range(arguments.repeat):
        latencies.take()
        rospy.sleep(arguments.seconds)
        without += latencies.take()
        print("%s (load %.1f)" % (train(dataset=arguments.dataset).message, os.getloadavg()[0]))
        during += latencies.take()
    if not without or not during:
        sys.exit("no detections came: are clouds published?")
    ratios = [b / a for a, b in zip(summary("without", without), summary("training", during))]
    print("with training: p50 %.2f, p95 %.2f, longest %.2f times those without" % tuple(ratios))


if __name__ == "__main__":
    main()
