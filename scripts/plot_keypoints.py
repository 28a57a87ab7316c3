#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the ranked curves of `sks keypoints --plot DIR` (keypoints.csv) as a PNG file."""
import argparse
import csv
import os
import sys

try:
    import matplotlib

    matplotlib.use('Agg')
    from matplotlib import pyplot as plt
except ImportError as error:
    sys.exit(f'plot_keypoints.py: {error}; plots need matplotlib: sudo apt-get install python3-matplotlib')

T_DIFF_SHOWN = 5.0  # two rotations differ by at most 2 sqrt(2)


def read(path):
    """Ranks, C_rk and T_diff of each kind, in the order of the file."""
    kinds = {}
    with open(path, encoding='utf-8', newline='') as file:
        for row in csv.DictReader(file):
            kinds.setdefault(row['keypoints'], []).append(row)
    return kinds


def draw(axes, kinds, key, label, limit):
    for name, rows in kinds.items():
        rows = [row for row in rows if row[key] != '']
        axes.plot([int(row['rank']) for row in rows], [float(row[key]) for row in rows], marker='.', label=name)
    axes.set(xlabel='pairs of object and scene, best first', ylabel=label)
    axes.set_ylim(bottom=0, top=min(limit, axes.get_ylim()[1]))
    axes.grid(alpha=0.3)
    axes.legend()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--check', action='store_true', help='only check that plots can be drawn here')
    parser.add_argument('csv', nargs='?', help='keypoints.csv')
    parser.add_argument('folder', nargs='?', help='where keypoints.png goes')
    arguments = parser.parse_args()
    if arguments.check:
        return
    if arguments.folder is None:
        parser.error('give the CSV file and the folder')
    kinds = read(arguments.csv)
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5))
    draw(axes[0], kinds, 'c_rk', '$C_{rk}$: inliers / keypoints of the object', 1.0)
    draw(axes[1], kinds, 't_diff', '$T_{diff}$', T_DIFF_SHOWN)
    figure.savefig(os.path.join(arguments.folder, 'keypoints.png'), dpi=120, bbox_inches='tight')


if __name__ == '__main__':
    main()
