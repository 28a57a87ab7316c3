#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes what the tests share: a data set of synthetic training views, and the codebook trained from it."""
import os
import subprocess
import sys

import numpy as np
import yaml

import synthetic


def write_pcd(path, points):
    count = len(points)
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\n"
              "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n").format(count)
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(points.astype(np.float32).tobytes())


def main(folder):
    os.makedirs(folder, exist_ok=True)
    training = []
    for name in synthetic.SHAPES:
        write_pcd(os.path.join(folder, name + ".pcd"), synthetic.training_view(name))
        training.append({"object": name, "cloud": name + ".pcd", "kind": "view"})
    dataset = os.path.join(folder, "synthetic.yaml")
    with open(dataset, "w") as file:
        yaml.safe_dump({"name": "synthetic", "units": "m", "training": training}, file)
    subprocess.check_call(["rosrun", "sks_detector", "sks", "train", "--dataset", dataset, "--output",
                           os.path.join(folder, "synthetic.sks")])


if __name__ == "__main__":
    main(sys.argv[1])
