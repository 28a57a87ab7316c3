# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of an object on a table, by a virtual camera that stands anywhere around it, and the detector that is trained
with them."""
import json
import os
import signal
import subprocess
import threading

import geometry_msgs.msg
import numpy as np
import rosbag
import rospy
import std_msgs.msg
import tf2_ros

import services_support
import support

TABLE = {"elevation": 35, "distance": 0.7}
AROUND = [dict(TABLE, degrees=30 * i) for i in range(12)]
ELSEWHERE = [{"degrees": 10 + 36 * i, "elevation": 28 + 3 * i, "distance": 0.6 + 0.03 * (i * 3 % 10)}
             for i in range(10)]


def angle_of(R):
    """[degrees]"""
    return np.degrees(np.arccos(np.clip((np.trace(R[:3, :3]) - 1) / 2, -1, 1)))


class Picture:
    """A frame of a recording, with the camera's pose on the table and the frame that the object's model has where this
    is its first view, both as T_table."""

    def __init__(self, cloud, transform, truth):
        self.cloud = cloud
        self.transform = transform
        self.T_table_camera = support.matrix_of_transform(transform)
        self.T_table_model = self.T_table_camera @ support.matrix_of(truth.pose.pose)


def recorded(folder, pictures):
    """What the virtual camera sees."""
    lists, bag = os.path.join(folder, "pictures.json"), os.path.join(folder, "pictures.bag")
    with open(lists, "w") as file:
        json.dump(pictures, file)
    subprocess.check_call(["rosrun", "sks_detector", "record_table", lists, bag])
    topics = {"/camera/depth_registered/points": [], "/tf": [], "/ground_truth": []}
    with rosbag.Bag(bag) as recording:
        for topic, message, _ in recording.read_messages(topics):
            topics[topic].append(message)
    os.remove(bag)
    clouds, transforms, truths = topics.values()
    return [Picture(cloud, tf.transforms[0].transform, truth.detections[0])
            for cloud, tf, truth in zip(clouds, transforms, truths)]


class Camera:
    """Publishes the picture that it is shown, over and over; where the table has a frame, its own pose before it."""

    def __init__(self, topic, table=None):
        self._source = support.CloudSource(topic, queue_size=1)
        self._table = table
        self._broadcaster = tf2_ros.TransformBroadcaster() if table else None
        self._lock = threading.Lock()
        self._picture = None
        self._timer = rospy.Timer(rospy.Duration(0.2), self._publish)

    def show(self, picture):
        """The time from which on clouds show it."""
        with self._lock:
            self._picture = picture
            return rospy.Time.now()

    def _publish(self, _):
        with self._lock:
            if not self._picture or self._source.publisher.get_num_connections() == 0:
                return
            cloud = self._picture.cloud
            cloud.header.stamp = rospy.Time.now()
            if self._table:
                header = std_msgs.msg.Header(stamp=cloud.header.stamp, frame_id=self._table)
                self._broadcaster.sendTransform(
                    geometry_msgs.msg.TransformStamped(header, cloud.header.frame_id, self._picture.transform))
            self._source.publisher.publish(cloud)

    def stop(self):
        self._timer.shutdown()


class TrainLaunch:
    """train.launch with folders of its own, and the services of its detector."""

    def __init__(self, folder, *arguments):
        self._launch = subprocess.Popen(["roslaunch", "sks_detector", "train.launch", "folder:=" + folder, *arguments])
        self.services = {name: rospy.ServiceProxy("/detector/" + name, kind)
                         for name, kind in services_support.TYPES.items()}
        for service in self.services.values():
            service.wait_for_service(support.PATIENCE)

    def stop(self):
        self._launch.send_signal(signal.SIGINT)
        self._launch.wait(support.PATIENCE)
