#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints which objects a bag of detections with ~tracking follows, from when to when, and in how many of the clouds."""
import argparse
import sys

import rosbag


class Track:
    def __init__(self, name, stamp):
        self.name, self.first, self.last = name, stamp, stamp
        self.clouds, self.score = 0, 0.0

    def add(self, detection, stamp):
        self.clouds += 1
        self.score += detection.score
        self.last = stamp


def tracks_of(messages):
    """Tracks by their numbers, and the stamps of all clouds [s]."""
    tracks, stamps = {}, []
    for message in messages:
        stamp = message.header.stamp.to_sec()
        stamps.append(stamp)
        for detection in message.detections:
            if detection.id:
                tracks.setdefault(detection.id, Track(detection.object, stamp)).add(detection, stamp)
    return tracks, stamps


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('bag', help='recorded by replay.launch record:=FILE tracking:=true')
    parser.add_argument('--topic', default='/detector/detections', help='default: %(default)s')
    arguments = parser.parse_args()
    with rosbag.Bag(arguments.bag) as bag:
        tracks, stamps = tracks_of(m for _, m, _ in bag.read_messages(topics=[arguments.topic]))
    if not tracks:
        sys.exit(f'{arguments.bag}: {len(stamps)} clouds on {arguments.topic}, in which nothing was followed; '
                 'searches run beside the clouds at low priority: is the machine busy?')
    print(f'\n{len(stamps)} clouds in {stamps[-1] - stamps[0]:.1f} s')
    print(f"{'id':>4}  {'object':<18}from [s]  to [s]  clouds  score")
    for number, track in sorted(tracks.items()):
        print(f'{number:>4}  {track.name:<18}{track.first - stamps[0]:8.2f}{track.last - stamps[0]:8.2f}'
              f'{track.clouds:8d}{track.score / track.clouds:7.2f}')
    print()


if __name__ == '__main__':
    main()
