#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""camera.launch with the synthetic camera, which can be unplugged, and OpenNI2's Dummy device beside it."""
import os
import sys
import unittest

import numpy as np
import rosnode
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from camera_testing import ERROR, OK, Diagnostics, Recorder, points_of, synthetic_view, values, wait_for  # noqa: E402


class CameraTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.state = rospy.get_param('~state')
        cls.diagnostics = Diagnostics()

    def setUp(self):
        self.set_state('')

    def tearDown(self):
        self.set_state('')
        self.assertTrue(rosnode.rosnode_ping('/sks_manager', max_count=1), 'the manager is gone')

    def set_state(self, state):
        with open(self.state, 'w') as file:
            file.write(state)

    def record(self, topic, message_type):
        recorder = Recorder(topic, message_type)
        self.addCleanup(recorder.close)
        return recorder

    def cloud(self, topic='/camera/points'):
        return rospy.wait_for_message(topic, PointCloud2, 30.0)

    def check_view(self, cloud):
        points = points_of(cloud)
        x, y, z, rgb = synthetic_view(cloud.width, cloud.height)
        for name, expected in (('x', x), ('y', y), ('z', z)):
            np.testing.assert_allclose(points[name], expected, atol=1e-3, equal_nan=True)
        np.testing.assert_array_equal(points['rgb'], rgb)

    def test_cloud_shows_places_and_colours(self):
        cloud = self.cloud()
        self.assertEqual(cloud.header.frame_id, 'camera_rgb_optical_frame')
        self.assertEqual([field.name for field in cloud.fields], ['x', 'y', 'z', 'rgb'])
        self.assertEqual((cloud.width, cloud.height, cloud.is_dense), (640, 480, False))
        self.assertEqual(cloud.row_step * cloud.height, len(cloud.data))
        self.check_view(cloud)

    def test_messages_of_one_frame_share_its_stamp(self):
        kinds = {'points': PointCloud2, 'camera_info': CameraInfo, 'depth_image': Image, 'color_image': Image}
        recorders = {name: self.record('/camera/' + name, kind) for name, kind in kinds.items()}

        def whole_frames():
            return set.intersection(*({message.header.stamp for message in list(recorder.messages)}
                                      for recorder in recorders.values()))
        wait_for(lambda: len(whole_frames()) > 2, 'frames of which all messages came')
        for recorder in recorders.values():
            recorder.close()
        received = {name: recorder.messages for name, recorder in recorders.items()}
        for messages in received.values():
            times = [message.header.stamp for message in messages]
            self.assertEqual(times, sorted(set(times)), 'stamps do not rise')
        info = received['camera_info'][0]
        np.testing.assert_allclose(info.K, [525, 0, 319.5, 0, 525, 239.5, 0, 0, 1], atol=1e-3)
        self.assertEqual((info.width, info.height, info.header.frame_id), (640, 480, 'camera_rgb_optical_frame'))
        depth, color = received['depth_image'][0], received['color_image'][0]
        self.assertEqual((depth.encoding, color.encoding), ('16UC1', 'rgb8'))
        z = synthetic_view(640, 480)[2]
        pixels = np.frombuffer(depth.data, '<u2').reshape(480, 640)
        np.testing.assert_array_equal(pixels, np.nan_to_num(np.round(1000 * z)))
        self.assertEqual(np.frombuffer(color.data, 'u1').reshape(480, 640, 3)[240, 250].tolist(), [200, 30, 20])

    def test_runs_only_while_somebody_listens(self):
        self.diagnostics.wait('camera', 'idle', OK)
        recorder = self.record('/camera/camera_info', CameraInfo)
        recorder.wait()
        status = values(self.diagnostics.wait('camera', 'running', OK))
        self.assertEqual(status['device'], 'SKS synthetic camera')
        self.assertEqual(status['serial number'], 'SKS-0001')
        self.assertEqual(status['depth'], '640x480 at 30 Hz')
        recorder.close()
        before = values(self.diagnostics.wait('camera', 'idle', OK))['frames']
        self.cloud('/dummy/points')
        self.assertEqual(values(self.diagnostics.wait('camera', 'idle', OK))['frames'], before)

    def test_comes_back_after_it_was_unplugged(self):
        recorder = self.record('/camera/points', PointCloud2)
        recorder.wait()
        before = int(values(self.diagnostics.wait('camera', 'running'))['reconnects'])
        self.set_state('unplugged')
        self.diagnostics.wait('camera', 'cannot be opened', ERROR)
        self.set_state('')
        self.check_view(recorder.wait(2)[1])
        recorder.close()
        after = int(values(self.diagnostics.wait('camera', 'idle', OK))['reconnects'])
        self.assertGreater(after, before)

    def test_comes_back_after_it_fell_silent(self):
        recorder = self.record('/camera/points', PointCloud2)
        recorder.wait()
        before = int(values(self.diagnostics.wait('camera', 'running'))['reconnects'])
        self.set_state('silent')
        self.diagnostics.wait('camera', 'no frame for 1 s', ERROR)
        self.set_state('')
        self.check_view(recorder.wait(2)[1])
        recorder.close()
        after = int(values(self.diagnostics.wait('camera', 'idle', OK))['reconnects'])
        self.assertGreater(after, before)

    def test_dummy_device(self):
        recorder = self.record('/dummy/points', PointCloud2)
        clouds = recorder.wait(10)
        recorder.close()
        cloud = clouds[0]
        self.assertEqual((cloud.width, cloud.height), (320, 240))
        self.assertEqual(cloud.header.frame_id, 'dummy_frame')
        duration = (clouds[-1].header.stamp - cloud.header.stamp).to_sec()
        self.assertGreater(duration, 9 / 60.0)
        first_row = points_of(cloud)[0]
        np.testing.assert_allclose(first_row['z'], 2.0)
        np.testing.assert_allclose(first_row['x'], 2.0 * (np.arange(320) - 159.5) / 262.5, atol=1e-4)
        self.assertTrue(np.isnan(points_of(cloud)['z']).any())


if __name__ == '__main__':
    rospy.init_node('camera_test')
    rostest.rosrun('sks_detector', 'camera_test', CameraTest)
