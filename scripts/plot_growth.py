#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how time, memory and accuracy grow with the number of objects (growth.json of measure_growth.py) and with the number of
codewords (scripts/benchmark --benchmark_filter=growth --benchmark_format=json), as SVG."""
import argparse
import json
import sys

try:
    import matplotlib

    matplotlib.use('Agg')
    from matplotlib import pyplot as plt
except ImportError as error:
    sys.exit(f'plot_growth.py: {error}; plots need matplotlib: sudo apt-get install python3-matplotlib')


def draw(axes, x, series, **names):
    """Lines over a logarithmic axis."""
    for label, values in series.items():
        points = [(a, b) for a, b in zip(x, values) if b is not None]
        axes.plot(*zip(*points), marker='o', label=label)
    axes.set(xscale='log', **names)
    axes.set_xticks(x)
    axes.set_xticklabels([f'{n:,}' if n < 10000 else f'{n / 1e6:g}M' if n >= 1000000 else f'{n // 1000}k' for n in x])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)


def objects(axes, growth):
    rows = growth['rows']
    counts = [row['objects'] for row in rows]

    def column(key):
        return [row[key] for row in rows]

    draw(axes[0], counts, {'frame': column('frame_cpu_s'), 'start to first answer': column('first_answer_cpu_s'),
                           'training': column('train_cpu_s')}, ylabel='CPU seconds', yscale='log', title='time')
    draw(axes[1], counts, {'codebook file': column('file_mb'), 'training, peak': column('train_mb'),
                           'detection, peak': column('detect_mb')}, ylabel='MB', yscale='log', title='memory')
    scores = {}
    for name in growth['alone']:
        scores[name] = [row['scores'].get(name, {}).get('f1') for row in rows]
    for number, (name, score) in enumerate(growth['alone'].items()):
        axes[2].axhline(score['f1'], linestyle=':', color=f'C{number}', label=f'{name}, its objects alone')
    draw(axes[2], counts, scores, ylabel='F1', ylim=(0, 1.05), title='accuracy')
    for panel in axes:
        panel.set_xlabel('objects')


def words(axes, benchmark):
    runs = [run for run in benchmark['benchmarks'] if run.get('run_type') == 'iteration']
    counts = [int(run['name'].split('/')[1]) for run in runs]
    draw(axes[0], counts, {'matching a frame, each of two threads': [run['cpu_time'] for run in runs]}, ylabel='CPU ms', yscale='log',
         title='time')
    # Few codewords find room in memory that was in use before: nothing can be said of theirs.
    draw(axes[1], counts, {'search structure': [run['bytes_per_word'] if int(run['bytes_per_word']) > 300 else None for run in runs]},
         ylabel='bytes a codeword', ylim=(0, 500), title='memory')
    draw(axes[2], counts, {'nearest codewords found': [run['share_of_nearest'] for run in runs]}, ylabel='fraction',
         ylim=(0.85, 1.005), title='recall')
    for panel in axes:
        panel.set_xlabel('codewords')


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--growth', required=True, help='growth.json')
    parser.add_argument('--words', required=True, help='JSON of the benchmark')
    parser.add_argument('--output', required=True, help='SVG file')
    options = parser.parse_args()
    with open(options.growth, encoding='utf-8') as file:
        growth = json.load(file)
    with open(options.words, encoding='utf-8') as file:
        benchmark = json.load(file)
    plt.rcParams.update({'svg.hashsalt': 'growth', 'svg.fonttype': 'none'})  # the same figures give the same bytes, and few of them
    figure, axes = plt.subplots(2, 3, figsize=(11, 6.5))
    objects(axes[0], growth)
    words(axes[1], benchmark)
    figure.tight_layout()
    figure.savefig(options.output, metadata={'Date': None})


if __name__ == '__main__':
    main()
