#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plays an .oni file that openni::Recorder wrote, mirrored as cameras do by default."""
import os
import subprocess
import sys
import unittest

import numpy as np
import rospy
import rostest
from sensor_msgs.msg import PointCloud2

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from camera_testing import ERROR, OK, Diagnostics, Recorder, points_of, synthetic_view, values, wait_for  # noqa: E402


class RecordingTest(unittest.TestCase):
    def setUp(self):
        self.recording = rospy.get_param('~recording')
        self.diagnostics = Diagnostics()

    def tearDown(self):
        os.remove(self.recording)

    def record(self):
        """Writes the file aside, so that it appears as a whole."""
        aside = self.recording + '.part'
        subprocess.run([rospy.get_param('~recorder'), 'sks-test://0', aside, '1.0', '320'], check=True, timeout=60)
        os.rename(aside, self.recording)

    def check(self, cloud):
        self.assertEqual((cloud.width, cloud.height), (320, 240))
        x, y, z, rgb = synthetic_view(320, 240)
        points = points_of(cloud)
        for name, expected in (('x', x), ('y', y), ('z', z)):
            np.testing.assert_allclose(points[name], expected, atol=1e-3, equal_nan=True)
        np.testing.assert_array_equal(points['rgb'], rgb)

    def test_recording(self):
        if os.path.exists(self.recording):
            os.remove(self.recording)
        for node in ('again_and_again', 'once'):
            self.diagnostics.wait(node, 'No such file', ERROR)

        again_and_again = Recorder('/again_and_again/points', PointCloud2)
        once = Recorder('/once/points', PointCloud2)
        wait_for(lambda: once.subscriber.get_num_connections() > 0, 'the node connects')
        self.record()

        clouds = again_and_again.wait(130)  # more than twice what was recorded at up to 60 Hz
        for cloud in clouds[::40]:
            self.check(cloud)
        stamps = [cloud.header.stamp for cloud in clouds]
        self.assertEqual(stamps, sorted(set(stamps)), 'stamps do not rise')
        self.assertGreater((stamps[-1] - stamps[0]).to_sec(), 0.8 * 129 / 60.0, 'faster than it was recorded')

        status = values(self.diagnostics.wait('once', 'the recording has ended', OK))
        self.assertEqual(status['device'], self.recording)
        self.assertTrue(10 < int(status['frames']) < 110, status['frames'])  # of about 60, and not twice
        self.check(wait_for(lambda: once.messages, 'a cloud')[-1])


if __name__ == '__main__':
    rospy.init_node('recording_test')
    rostest.rosrun('sks_detector', 'recording_test', RecordingTest)
