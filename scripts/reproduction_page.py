# SPDX-License-Identifier: BSD-3-Clause
"""The page of scripts/reproduce: tables and plots of what it ran, beside the figures of the paper."""
import os
import shutil

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plot  # noqa: E402

plot.rcParams['svg.hashsalt'] = 'sks_detector'  # so that the same figures give the same file

NAMES = {'sks': 'this package', 'sks-paper': 'published method', 'tombari': 'Tombari', 'chen': 'Chen', 'aldoma': 'Aldoma',
         'zhou': 'Zhou', 'knopp': 'Knopp', 'seib': 'Seib'}
SELECTIONS = {0: 'all', 0.25: 'SKS-25', 0.5: 'SKS-50', 0.75: 'SKS-75'}

# "Object Detection in Cluttered Environments with Sparse Keypoint Selection", i7-2760QM:
# F1 on RandomViews, on Kinect, seconds per scene on both; by method and share that is dropped
PAPER_DETECTION = {
    ('aldoma', 0): (0.08, 0.02, 2.0, 3.5), ('aldoma', 0.5): (0.09, 0.01, 1.5, 1.5),
    ('tombari', 0): (0.42, 0.41, 2.1, 2.2), ('tombari', 0.5): (0.35, 0.44, 1.4, 1.1),
    ('zhou', 0): (0.32, 0.07, 2.2, 2.1), ('zhou', 0.5): (0.23, 0.17, 1.8, 1.7),
    ('sks-paper', 0): (0.70, 0.44, 2.0, 1.8), ('sks-paper', 0.25): (0.77, 0.45, 1.9, 1.5),
    ('sks-paper', 0.5): (0.83, 0.51, 1.6, 1.1), ('sks-paper', 0.75): (0.83, 0.45, 1.2, 0.9)}
# accuracy on the Princeton Shape Benchmark, ModelNet10, ModelNet40, Washington RGB-D, BigBIRD
PAPER_CLASSIFICATION = {
    'knopp': '0.37, 0.25, -, -, -', 'chen': '0.62, 0.78, 0.73, 0.63, 0.45', 'tombari': '0.65, 0.82, 0.77, 0.80, 0.63',
    'zhou': '0.64, 0.84, 0.78, 0.73, 0.60', 'seib': '0.68, 0.86, 0.81, 0.85, 0.76',
    'sks-paper': '0.65, 0.81, 0.77, 0.83, 0.71'}
# relative time of keypoint detection
PAPER_KEYPOINTS = {'grid': 0.01, 'sks-50': 0.06, 'iss': 1.0}

BY_HAND = '<!-- What follows is written by hand and kept by scripts/reproduce. -->'


def number(value, digits):
    return '-' if value is None else f'{value:.{digits}f}'


def table(header, rows):
    lines = ['| ' + ' | '.join(cells) + ' |' for cells in [header, ['---'] * len(header)] + rows]
    return '\n'.join(lines) + '\n'


def named(method, discard):
    if method == 'sks-paper' and discard == 0:
        return 'grid baseline'
    return NAMES[method] if discard == 0 else f'{NAMES[method]}, {SELECTIONS[discard]}'


def paper_f1(data_set, method, discard):
    figures = PAPER_DETECTION.get((method, discard))
    if figures is None or not data_set.startswith(('kinect', 'random_views')):
        return '-'
    return number(figures[1 if data_set.startswith('kinect') else 0], 2)


def keypoints_per(result, key):
    return sum(entry['counts']['keypoints'] for entry in result[key]) / len(result[key])


def overview(runs):
    """F1 of every method on every set."""
    sets = list(dict.fromkeys(label for label, _, _ in runs))
    pairs = list(dict.fromkeys((job.method, job.discard) for _, job, _ in runs))
    f1 = {(label, job.method, job.discard): result['f1'] for label, job, result in runs}
    rows = []
    for method, discard in pairs:
        values = [f1.get((label, method, discard)) for label in sets]
        best = [max(v for (s, _, _), v in f1.items() if s == label and v is not None) for label in sets]
        cells = [f'**{number(v, 2)}**' if v is not None and v >= top else number(v, 2) for v, top in zip(values, best)]
        rows.append([named(method, discard)] + cells + [paper_f1('kinect', method, discard),
                                                         paper_f1('random_views', method, discard)])
    return table(['method'] + sets + ['paper: Kinect', 'paper: RandomViews'], rows)


def detection_tables(runs):
    text = ''
    for data_set in dict.fromkeys(label for label, _, _ in runs):
        rows = []
        for label, job, result in runs:
            if label != data_set:
                continue
            rows.append([named(job.method, job.discard), number(result['f1'], 3), number(result['average_precision'], 3),
                         number(result['precision'], 2), number(result['recall'], 2),
                         number(result['time_ms']['total']['mean'] / 1000, 2), f"{keypoints_per(result, 'per_scene'):.0f}",
                         paper_f1(data_set, job.method, job.discard)])
        text += f'\n### {data_set}\n\n' + table(
            ['method', 'F1', 'AP', 'precision', 'recall', 's per scene', 'keypoints', "paper's F1"], rows)
    return text


def classification_tables(runs):
    text = ''
    for data_set in dict.fromkeys(label for label, _, _ in runs):
        here = [(job, result) for label, job, result in runs if label == data_set]
        discards = list(dict.fromkeys(job.discard for job, _ in here))
        rows = []
        for method in dict.fromkeys(job.method for job, _ in here):
            of = {job.discard: result for job, result in here if job.method == method}
            seconds = of[0]['time_ms']['total']['mean'] / 1000 if 0 in of else None
            rows.append([NAMES[method]] + [number(of[discard]['accuracy'] if discard in of else None, 3)
                                           for discard in discards] +
                        [number(seconds, 2), PAPER_CLASSIFICATION.get(method, '-')])
        selections = [SELECTIONS[discard] for discard in discards]
        tests = here[0][1]['tests']
        text += f'\n### {data_set}: accuracy, {tests} tests\n\n' + table(
            ['method'] + selections + ['s per object', 'paper: PSB, MN10, MN40, WASH, BIGB'], rows)
    return text


def keypoint_tables(runs):
    text = ''
    for label, _, result in runs:
        rows = []
        for name, keypoints in result['keypoints'].items():
            rows.append([name, f"{keypoints['object_keypoints']['mean']:.0f}", f"{keypoints['scene_keypoints']['mean']:.0f}",
                         number(keypoints['c_rk']['mean'], 3), number(keypoints['t_diff']['median'], 3),
                         number(keypoints['relative_time'], 4), number(PAPER_KEYPOINTS.get(name), 2)])
        text += f'\n### {label}: {result["pairs"]} pairs\n\n' + table(
            ['keypoints', 'of object', 'of scene', 'mean C_rk', 'median T_diff', 'relative time', "paper's"], rows)
        text += f'\n![C_rk and T_diff of each pair, best first](evaluation_keypoints_{label}.png)\n'
    return text


def plot_detection(runs, path):
    """F1 over seconds per scene: one line a method, through its selections."""
    sets = list(dict.fromkeys(label for label, _, _ in runs))
    figure, axes = plot.subplots(1, len(sets), figsize=(3.2 * len(sets), 3.4), sharey=True, squeeze=False)
    for axis, data_set in zip(axes[0], sets):
        for index, method in enumerate(dict.fromkeys(job.method for _, job, _ in runs)):
            of = [(result['time_ms']['total']['mean'] / 1000, result['f1'] or 0) for label, job, result in runs
                  if label == data_set and job.method == method]
            axis.plot(*zip(*of), marker='o', markersize=4, linewidth=1, color=f'C{index}', label=NAMES[method])
            axis.plot(*of[0], marker='s', markersize=7, color=f'C{index}')
        axis.set(title=data_set, xscale='log', ylim=(-0.02, 1.02), xlabel='s per scene')
        axis.grid(alpha=0.3)
    axes[0][0].set_ylabel('F1')
    axes[0][-1].legend(fontsize=7, loc='lower right')
    figure.tight_layout()
    figure.savefig(path, metadata={'Date': None})
    plot.close(figure)


def counted(number, what, plural='s'):
    return f'{number} {what}{"" if number == 1 else plural}'


def machine(processes, threads):
    model, memory = 'unknown processor', ''
    with open('/proc/cpuinfo', encoding='utf-8') as file:
        models = [line.split(':', 1)[1].strip() for line in file if line.startswith('model name')]
    if models:
        model = models[0]
    with open('/proc/meminfo', encoding='utf-8') as file:
        memory = f'{int(file.readline().split()[1]) / 2 ** 20:.0f} GiB'
    return f'{model}, {os.cpu_count()} cores, {memory}; {counted(processes, "process", "es")} of {counted(threads, "thread")} a run.'


def by_hand(path):
    """What stands in the page from BY_HAND on; empty where there is none."""
    if not os.path.exists(path):
        return ''
    with open(path, encoding='utf-8') as file:
        _, mark, rest = file.read().partition(BY_HAND)
    return mark + rest


def write(path, runs, pictures, processes, threads):
    """@param runs [(name of the data set, job, result)] @param pictures [(name of the data set, file)]"""
    folder = os.path.dirname(os.path.abspath(path))
    by_command = {command: [run for run in runs if run[1].command == command]
                  for command in ('evaluate', 'classify', 'keypoints')}
    text = ['# Figures of every method\n\nHow to evaluate, data set files and measures: [evaluate.md](evaluate.md). Written by '
            '`scripts/reproduce`, which runs all of it again:\n\n```\n'
            'scripts/reproduce --data $SKS_DATA [D.yaml ...]\n```\n\n'
            f'Machine: {machine(processes, threads)} Times are wall-clock times: on a machine with other work they say little.\n'
            'Settings of the methods and how they were found: [baselines.md](baselines.md).\n'
            'The paper\'s data sets: RandomViews and Kinect of UniBo; its times are those of an i7-2760QM.\n']
    if by_command['evaluate']:
        plot_detection(by_command['evaluate'], os.path.join(folder, 'evaluation_detection.svg'))
        text.append('## Detection\n\nF1 at each method\'s fixed threshold (0.5), `sks evaluate --dataset D --codebook B --method M '
                    '--set keypoints.discard=S`, B trained with the default settings:\n\n' + overview(by_command['evaluate']) +
                    '\n![F1 over seconds per scene; squares: without selection](evaluation_detection.svg)\n' +
                    detection_tables(by_command['evaluate']))
    if by_command['classify']:
        text.append('## Classification\n\n`sks classify --dataset D --codebook B --method M --set keypoints.discard=S`, B '
                    'trained with `config/classify.yaml`:\n' + classification_tables(by_command['classify']))
    if by_command['keypoints']:
        text.append('## Keypoints\n\n`sks keypoints --dataset D --set threads=1`; times relative to ISS:\n' +
                    keypoint_tables(by_command['keypoints']))
        for label, picture in pictures:
            shutil.copy(picture, os.path.join(folder, f'evaluation_keypoints_{label}.png'))
    if by_hand(path):
        text.append(by_hand(path))
    with open(path, 'w', encoding='utf-8') as file:
        file.write('\n'.join(text))
