#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the node needs: starts detector.launch under a master of its own, sends clouds and prints seconds from the start of the
nodelet manager to the first answer, milliseconds from a cloud to its answer, CPU seconds a frame, and memory (resident now, and at
most). Clouds are PCD files of four-byte fields, binary or compressed. Needs a workspace with sks_detector that has been sourced."""
import argparse
import json
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

import rosgraph
import rospy
from sensor_msgs.msg import PointCloud2, PointField

POINTS, DETECTOR, MANAGER = '/points', '/detector', '/detector_manager'


def unpacked(data, size):
    """LZF, as PCD files have it."""
    out, at = bytearray(), 0
    while len(out) < size:
        control = data[at]
        at += 1
        if control < 32:
            out += data[at:at + control + 1]
            at += control + 1
            continue
        length, back = control >> 5, (control & 31) << 8
        if length == 7:
            length += data[at]
            at += 1
        start = len(out) - back - data[at] - 1
        at += 1
        for i in range(length + 2):
            out.append(out[start + i])
    return bytes(out)


def read_cloud(path):
    with open(path, 'rb') as file:
        header = {}
        while 'DATA' not in header:
            words = file.readline().decode('ascii').split()
            header[words[0]] = words[1:]
        data = file.read()
    names, types = header['FIELDS'], header['TYPE']
    if set(header['SIZE']) != {'4'} or header['DATA'] == ['ascii']:
        sys.exit(f'{path}: only binary PCD files of four-byte fields can be sent')
    points, step = int(header['WIDTH'][0]) * int(header['HEIGHT'][0]), 4 * len(names)
    if header['DATA'] == ['binary_compressed']:  # field by field
        packed, size = struct.unpack('<II', data[:8])
        columns = unpacked(data[8:8 + packed], size)
        rows = bytearray(points * step)
        for i in range(len(names)):
            for byte in range(4):
                rows[4 * i + byte::step] = columns[4 * points * i + byte:4 * points * (i + 1):4]
        data = bytes(rows)
    kinds = {'F': PointField.FLOAT32, 'U': PointField.UINT32, 'I': PointField.INT32}
    cloud = PointCloud2(height=int(header['HEIGHT'][0]), width=int(header['WIDTH'][0]))
    cloud.fields = [PointField(name, 4 * i, kinds[kind], 1) for i, (name, kind) in enumerate(zip(names, types))]
    cloud.point_step, cloud.row_step = step, step * cloud.width
    cloud.data = data[:points * step]
    cloud.header.frame_id = 'camera'
    return cloud


def now():
    """Since the machine was started [s], as processes count."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


class Answers:
    """When detections came; any type of message will do."""

    def __init__(self):
        self.times = []
        rospy.Subscriber(DETECTOR + '/detections', rospy.AnyMsg, lambda _: self.times.append(now()))

    def wait_for(self, count, timeout=60):
        end = now() + timeout
        while len(self.times) < count:
            if now() > end:
                sys.exit(f'waited {timeout} s for an answer of the detector')
            time.sleep(0.002)
        return self.times[count - 1]


class Process:
    def __init__(self, node):
        uri = rosgraph.Master('/measure').lookupNode(node)
        self.pid = xmlrpc.client.ServerProxy(uri).getPid('/measure')[2]

    def memory(self, key):
        with open(f'/proc/{self.pid}/status', encoding='ascii') as status:
            return int(dict(line.split(':', 1) for line in status)[key].split()[0]) * 1024 / 1e6  # it counts KiB

    def _stat(self, first, count=1):
        """The sum of some numbers of clock ticks, counted as in `man proc`, in seconds."""
        with open(f'/proc/{self.pid}/stat', encoding='ascii') as stat:
            fields = stat.read().rsplit(')', 1)[1].split()  # from the third on
        return sum(int(field) for field in fields[first - 3:first - 3 + count]) / os.sysconf('SC_CLK_TCK')

    def cpu(self):
        return self._stat(14, 2)

    def start(self):
        return self._stat(22)


def launch(folder, options):
    with socket.socket() as probe:
        probe.bind(('', 0))
        port = str(probe.getsockname()[1])
    os.environ.update(ROS_MASTER_URI='http://localhost:' + port, ROS_HOSTNAME='localhost', ROS_LOG_DIR=folder)
    command = ['roslaunch', '--port', port, 'sks_detector', 'detector.launch', 'respawn:=false', 'points:=' + POINTS,
               'codebook:=' + os.path.abspath(options.codebook)]
    if options.config:
        command.append('config:=' + os.path.abspath(options.config))
    with open(os.path.join(folder, 'launch.log'), 'w', encoding='utf-8') as log:
        return subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT)


def wait_for(condition, what, timeout=60):
    end = now() + timeout
    while not condition():
        if now() > end:
            sys.exit(f'waited {timeout} s for {what}')
        time.sleep(0.002)


def measure(clouds, options):
    answers = Answers()
    publisher = rospy.Publisher(POINTS, PointCloud2, queue_size=1)
    wait_for(lambda: publisher.get_num_connections() > 0, 'the detector')
    sent, latencies = 0, []
    process = Process(MANAGER)
    cpu = 0
    for _ in range(options.passes):
        cpu, before = process.cpu(), sent
        latencies = []
        for cloud in clouds:
            cloud.header.stamp = rospy.Time.now()
            start = now()
            publisher.publish(cloud)
            sent += 1
            latencies.append(1000 * (answers.wait_for(sent) - start))
        cpu = (process.cpu() - cpu) / (sent - before)
    latencies.sort()
    return {'first_answer_s': answers.times[0] - process.start(), 'latency_ms': latencies[len(latencies) // 2],
            'latency_p95_ms': latencies[int(0.95 * (len(latencies) - 1))], 'frame_cpu_s': cpu,
            'resident_mb': process.memory('VmRSS'), 'most_mb': process.memory('VmHWM')}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--codebook', required=True, help='codebook file (*.sks)')
    parser.add_argument('--config', help='settings file (YAML); none: config/default.yaml')
    parser.add_argument('--passes', type=int, default=3, help='over the clouds, of which the last one counts (default: 3)')
    parser.add_argument('clouds', nargs='+', help='PCD files')
    options = parser.parse_args()
    clouds = [read_cloud(path) for path in options.clouds]
    with tempfile.TemporaryDirectory(prefix='sks_node_') as folder:
        detector = launch(folder, options)
        try:
            wait_for(rosgraph.is_master_online, 'the master')
            rospy.init_node('measure', disable_signals=True)
            print(json.dumps(measure(clouds, options), indent=2))
        finally:
            detector.send_signal(signal.SIGINT)
            detector.wait(60)


if __name__ == '__main__':
    main()
