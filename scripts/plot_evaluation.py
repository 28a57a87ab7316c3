#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the results of `sks evaluate --json FILE` as PNG files: precision-recall curves, threshold sweep, times."""
import argparse
import json
import os
import sys

try:
    import matplotlib

    matplotlib.use('Agg')
    from matplotlib import pyplot as plt
except ImportError as error:
    sys.exit(f'plot_evaluation.py: {error}; plots need matplotlib: sudo apt-get install python3-matplotlib')

STAGES = ['sanitize', 'normals', 'keypoints', 'descriptors', 'matching', 'voting', 'verification']


def text(value):
    """A measure for a label; undefined values are null in the file."""
    return '–' if value is None else f'{value:.2f}'


def draw_curve(axes, score, **style):
    """One precision-recall curve, extended to recall 0 at the precision of its best detection."""
    curve = score['curve']
    if score['ground_truth'] == 0 or not curve['recall']:
        return
    axes.plot([0] + curve['recall'], curve['precision'][:1] + curve['precision'], **style)


def plot_precision_recall(result, path):
    figure, axes = plt.subplots(figsize=(8, 5.5))
    for name, score in sorted(result['per_object'].items()):
        label = f"{name} (AP {text(score['average_precision'])})"
        draw_curve(axes, score, label=label, color=score['color'], linewidth=1.2)
    draw_curve(axes, result, label=f"all (AP {text(result['average_precision'])})", color='black', linewidth=2.5)
    if result['precision'] is not None and result['recall'] is not None:
        axes.plot(result['recall'], result['precision'], 'o', color='black', markersize=8, clip_on=False, zorder=5,
                  label=f"threshold {result['threshold']:g} (F1 {text(result['f1'])})")
    axes.set(xlabel='recall', ylabel='precision', xlim=(0, 1.02), ylim=(0, 1.02),
             title=f"{result['dataset']}, {result['method']}: precision and recall")
    axes.grid(alpha=0.3)
    if axes.lines:
        axes.legend(loc='center left', bbox_to_anchor=(1.01, 0.5), frameon=False)
    else:
        reason = 'nothing was detected' if result['ground_truth'] else 'no ground truth'
        axes.text(0.5, 0.5, reason, ha='center', va='center', transform=axes.transAxes)
    save(figure, path)


def plot_threshold_sweep(result, path):
    figure, axes = plt.subplots(figsize=(8, 5))
    sweep = result['threshold_sweep']
    thresholds = [point['threshold'] for point in sweep]
    for key, label in (('precision', 'precision'), ('recall', 'recall'), ('f1', 'F1')):
        values = [float('nan') if point[key] is None else point[key] for point in sweep]
        axes.plot(thresholds, values, marker='.', label=label, linewidth=2.5 if key == 'f1' else 1.5)
    axes.axvline(result['threshold'], color='black', linestyle=':', label=f"set: {result['threshold']:g}")
    axes.set(xlabel='score threshold', xlim=(0, 1), ylim=(0, 1.02),
             title=f"{result['dataset']}, {result['method']}: what a threshold would give")
    axes.grid(alpha=0.3)
    axes.legend(loc='center left', bbox_to_anchor=(1.01, 0.5), frameon=False)
    save(figure, path)


def plot_times(result, path):
    figure, axes = plt.subplots(figsize=(8, 4))
    stages = [stage for stage in STAGES if stage in result['time_ms']] or ['total']
    times = [result['time_ms'][stage] for stage in stages]
    rows = range(len(stages))
    axes.barh(rows, [time['mean'] for time in times], color='C0', label='mean')
    axes.plot([time['p95'] for time in times], rows, '|', color='black', markersize=14, markeredgewidth=2,
              label='95th percentile')
    for row, time in zip(rows, times):
        axes.annotate(f"{time['mean']:.1f}", (max(time['mean'], time['p95']), row), xytext=(6, 0),
                      textcoords='offset points', va='center')
    total = result['time_ms']['total']
    axes.set(xlabel='time of a scene [ms]', yticks=list(rows), yticklabels=stages,
             title=f"{result['dataset']}, {result['method']}: {total['mean']:.0f} ms a scene "
                   f"(95th percentile {total['p95']:.0f} ms)")
    axes.invert_yaxis()
    axes.margins(x=0.12)
    axes.set_xlim(left=0)
    axes.legend(loc='lower right')
    save(figure, path)


def save(figure, path):
    figure.savefig(path, dpi=120, bbox_inches='tight')
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--check', action='store_true', help='only check that plots can be drawn here')
    parser.add_argument('json', nargs='?', help='file written by sks evaluate --json')
    parser.add_argument('folder', nargs='?', help='where the PNG files go')
    arguments = parser.parse_args()
    if arguments.check:
        return
    if arguments.folder is None:
        parser.error('give the JSON file and the folder')
    with open(arguments.json, encoding='utf-8') as file:
        result = json.load(file)
    os.makedirs(arguments.folder, exist_ok=True)
    plot_precision_recall(result, os.path.join(arguments.folder, 'precision_recall.png'))
    plot_threshold_sweep(result, os.path.join(arguments.folder, 'threshold_sweep.png'))
    plot_times(result, os.path.join(arguments.folder, 'times.png'))


if __name__ == '__main__':
    main()
