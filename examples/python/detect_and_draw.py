#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains three objects that the package makes itself, simulates a table with them, detects, and draws what was found.

detect_and_draw.py [PICTURE [SKS]]: writes PICTURE (default: detections.png) with the command line SKS (default: sks)."""
import os
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use("Agg")  # no window
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import sks_detector  # noqa: E402

OBJECTS = {"mug": "builtin:mug", "duck": "builtin:duck", "drill": "builtin:drill"}
EDGES = [(a, a | bit) for a in range(8) for bit in (1, 2, 4) if not a & bit]  # of a box, between corners 0 to 7
MARGIN = 0.1  # around the boxes, in the units of the picture (x / z)


def simulate(sks):
    """One scene, as a camera would see it."""
    with tempfile.TemporaryDirectory() as folder:
        meshes = ["--mesh=%s=%s" % item for item in OBJECTS.items()]
        subprocess.run([sks, "simulate", *meshes, "--scenes", "1", "--objects", "3", "-o", folder + "/set"], check=True)
        return sks_detector.read_cloud(os.path.join(folder, "set", "scenes", "scene000.pcd"))


def corners(detection):
    """Of its box, 8 x 3, in the frame of the cloud [m]."""
    signs = np.array([[(i >> axis & 1) - 0.5 for axis in range(3)] for i in range(8)])
    return signs * detection.box_size @ detection.box_center[:3, :3].T + detection.position


def draw(cloud, detections, path):
    """As the camera sees it: x to the right and y down, divided by the depth z."""
    def image(points):
        return points[..., :2] / points[..., 2:]

    measured = np.isfinite(cloud.points).all(-1)
    figure, axes = plt.subplots(figsize=(8, 6))
    axes.scatter(*image(cloud.points[measured]).T, c=cloud.colors[measured] / 255, s=1, linewidths=0)
    for i, detection in enumerate(detections):
        box = image(corners(detection))
        for a, b in EDGES:
            axes.plot(*box[[a, b]].T, color="C%d" % i)
        axes.annotate("%s %.2f" % (detection.object, detection.score), image(detection.position), color="C%d" % i)
    if detections:
        around = image(np.concatenate([corners(detection) for detection in detections]))
        axes.set_xlim(around[:, 0].min() - MARGIN, around[:, 0].max() + MARGIN)
        axes.set_ylim(around[:, 1].min() - MARGIN, around[:, 1].max() + MARGIN)
    axes.set_aspect("equal")
    axes.invert_yaxis()
    axes.set_xlabel("x / z")
    axes.set_ylabel("y / z")
    figure.savefig(path, dpi=100)


def main():
    picture = sys.argv[1] if len(sys.argv) > 1 else "detections.png"
    sks = sys.argv[2] if len(sys.argv) > 2 else "sks"
    try:
        cloud = simulate(sks)
        codebook = sks_detector.train(meshes=OBJECTS)
        detections = sks_detector.Detector(codebook).detect(cloud)
    except (sks_detector.Error, OSError, subprocess.CalledProcessError) as error:
        sys.exit("detect_and_draw: %s" % error)
    for d in detections:
        print("%s %.3f at %s m" % (d.object, d.score, np.round(d.position, 3)))
    draw(cloud, detections, picture)
    print(picture)


if __name__ == "__main__":
    main()
