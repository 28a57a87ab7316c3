#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Clouds as no camera should send them: of any size, at odd times, malformed in every way. Each good one is answered."""
import random
import unittest

import numpy as np
import rospy
import rostest
from sensor_msgs.msg import PointField

import support
import synthetic
from sks_detector.msg import DetectionArray, Status


class FaultyCloudsTest(unittest.TestCase):
    def setUp(self):
        self.good = support.cloud_message(synthetic.scene())
        self.source = support.CloudSource("/points", queue_size=1000)  # a new one: rospy keeps connections to what has gone
        self.detections = support.Recorder("/detector/detections", DetectionArray)
        self.status = support.Recorder("/detector/status", Status)

    def tearDown(self):
        self.detections.close()
        self.status.close()
        self.source.publisher.unregister()

    def node(self, **parameters):
        return support.Node(parameters=dict(parameters, codebook=support.CODEBOOK))

    def expect_good(self):
        """A good cloud is answered, and both objects are found in it."""
        self.good.header.stamp = rospy.Time.now()
        answer = self.detections.wait_for_stamp(self.source.send(self.good))
        self.assertEqual(sorted(d.object for d in answer.detections), ["round", "thing"])

    def expect_refusal(self, cloud, reason):
        """An empty array; it is sent again until the status tells the reason, which it does at most once a second."""
        def told():
            cloud.header.stamp = rospy.Time.now()
            self.assertEqual(self.detections.wait_for_stamp(self.source.send(cloud)).detections, [])
            return any(reason in status.last_error for status in self.status.messages)
        support.wait_for(told, reason)

    def test_any_size(self):
        scene = synthetic.scene()
        with self.node() as node:
            self.source.wait_for_subscriber()
            for count in (0, 1, 2, 3, 10, 100):
                answer = self.detections.wait_for_stamp(
                    self.source.send(support.cloud_message(scene.reshape(-1, 3)[:count])))
                self.assertEqual(answer.detections, [], count)
            for factor in (1, 4, 8):  # 19,200, 307,200 and 1,228,800 points
                cloud = support.cloud_message(np.repeat(np.repeat(scene, factor, 0), factor, 1))
                answer = self.detections.wait_for_stamp(self.source.send(cloud))
                self.assertEqual(sorted(d.object for d in answer.detections), ["round", "thing"], factor)
            before = node.memory()
            for count in (2000001, 5000000, 20000000):
                self.expect_refusal(support.cloud_message(np.zeros((count, 3), np.float32)),
                                    "it has %d points, more than ~max_points = 2000000" % count)
                self.expect_good()
            self.assertLess(node.memory() - before, 300, "MB more after a message of 240 MB")

    def test_sizes_that_are_lies(self):
        with self.node() as node:
            self.source.wait_for_subscriber()
            for width, height, step in ((2**32 - 1, 2**32 - 1, 2**32 - 1), (2**32 - 1, 1, 12), (2**16, 2**16, 2**16),
                                        (2**31, 2, 2**32 - 1), (0, 2**32 - 1, 12), (2**32 - 1, 0, 0)):
                cloud = support.cloud_message(synthetic.scene())
                cloud.width, cloud.height, cloud.point_step, cloud.row_step = width, height, step, step
                answer = self.detections.wait_for_stamp(self.source.send(cloud))
                self.assertEqual(answer.detections, [])
            self.assertLess(node.memory(), 1000)
            self.expect_good()

    def test_any_stamp(self):
        self.expect_answers_to_any_stamp()

    def test_any_stamp_with_transforms(self):
        self.expect_answers_to_any_stamp(target_frame="camera", publish_tf=True)

    def test_any_stamp_that_is_not_too_old(self):
        self.expect_answers_to_any_stamp(rospy.Time.now() - rospy.Duration(3000), max_input_age=4000.0)

    def expect_answers_to_any_stamp(self, oldest=rospy.Time(0), **parameters):
        """Out of order, twice the same, in the future, none, and the ends of what a stamp can say."""
        now = rospy.Time.now()
        stamps = [now] + [now + rospy.Duration(offset) for offset in (-1, 1, -3600, 3600)]
        stamps += [rospy.Time(0), rospy.Time(1), rospy.Time(2**31), rospy.Time(2**32 - 1, 999999999)]
        with self.node(**parameters) as node:
            self.source.wait_for_subscriber()
            for stamp in stamps:
                if stamp.is_zero() or stamp > oldest:
                    self.expect_answers_to(stamp, 2)
            self.expect_good()
            self.assertTrue(node.alive())

    def expect_answers_to(self, stamp, count):
        """As many as there are clouds of that stamp, one after the other."""
        self.detections.clear()
        for number in range(1, count + 1):
            self.source.send(support.cloud_message(synthetic.scene(), stamp=stamp))
            support.wait_for(lambda: len(self.detections.messages) == number, "answer %d to %s" % (number, stamp))
        for answer in self.detections.messages:
            self.assertEqual(answer.header.stamp, stamp)
            self.assertEqual(len(answer.detections), 2)

    def test_ten_thousand_malformed_clouds_between_good_ones(self):
        generator = random.Random(1)
        small = support.cloud_message(synthetic.scene()[40:60, 60:90])
        with self.node() as node:
            self.source.wait_for_subscriber()
            self.expect_good()
            before = node.memory()
            for _ in range(100):
                self.detections.clear()
                for _ in range(100):  # one after the other: of those that come at once only the newest is looked at
                    cloud = malformed(small, generator)
                    cloud.header.stamp = rospy.Time.now()
                    answer = self.detections.wait_for_stamp(self.source.send(cloud))
                    self.assertEqual(answer.header.frame_id, "camera")
                self.expect_good()
            self.assertLess(node.memory() - before, 50)
            self.assertTrue(node.alive())


def malformed(cloud, generator):
    """A copy with one to three things wrong."""
    copy = type(cloud)(*(getattr(cloud, name) for name in cloud.__slots__))
    number = lambda: generator.choice((0, 1, 2, 3, 7, 11, 13, 255, 4096, 2**31 - 1, 2**31, 2**32 - 1,  # noqa: E731
                                       generator.getrandbits(generator.randint(1, 32))))
    field = generator.randrange(3)

    def change_field(**changes):
        old = copy.fields[field % len(copy.fields)] if copy.fields else PointField()
        values = dict(dict(name=old.name, offset=old.offset, datatype=old.datatype, count=old.count), **changes)
        copy.fields = copy.fields[:field] + [PointField(**values)] + copy.fields[field + 1:]

    def spoil_data():
        data = bytearray(copy.data)
        for _ in range(generator.randint(1, 200)):
            if data:
                data[generator.randrange(len(data))] = generator.choice((0, 127, 128, 255))
        copy.data = bytes(data)

    faults = [
        lambda: setattr(copy, "width", number()), lambda: setattr(copy, "height", number()),
        lambda: setattr(copy, "point_step", number()), lambda: setattr(copy, "row_step", number()),
        lambda: setattr(copy, "is_bigendian", True), lambda: setattr(copy, "is_dense", not copy.is_dense),
        lambda: setattr(copy, "data", copy.data[:generator.randint(0, len(copy.data))]),
        lambda: setattr(copy, "data", copy.data + bytes(generator.randint(1, 100))),
        lambda: setattr(copy, "fields", copy.fields[:field]),
        lambda: setattr(copy, "fields", copy.fields * generator.randint(0, 20)),
        lambda: change_field(offset=number()), lambda: change_field(count=number()),
        lambda: change_field(datatype=generator.randrange(256)),
        lambda: change_field(name=generator.choice(("", "x", "y", "z", "rgb", "rgba", "\u0000", "x" * 1000))),
        spoil_data,
    ]
    for fault in generator.sample(faults, generator.randint(1, 3)):
        fault()
    return copy


if __name__ == "__main__":
    rospy.init_node("faults_clouds_test")
    rostest.rosrun("sks_detector", "faults_clouds", FaultyCloudsTest)
