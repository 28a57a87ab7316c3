#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Evaluates `sks` on a development set, with config/default.yaml, and fails below the limits of accuracy_limits.yaml.
`--train` makes the codebook of a set instead, which other sets share. Data sets are those in $SKS_DATA; exit status 77,
which ctest shows as skipped, where they are not there."""
import argparse
import json
import os
import subprocess
import sys

import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 77
# key of the limits, key of the evaluation, name, whether more is better
MEASURES = [('f1', 'f1', 'F1', True), ('average_precision', 'average_precision', 'AP', True),
            ('false_alarms', 'false_positives', 'false alarms', False)]


def data_set(name):
    folder = os.environ.get('SKS_DATA')
    if not folder:
        sys.stdout.write('skipped: SKS_DATA, the folder of the recorded data sets, is not set\n')
        sys.exit(SKIPPED)
    path = os.path.join(folder, name, 'dataset.yaml')
    if not os.path.exists(path):
        sys.stdout.write(f'skipped: {path} is not there\n')
        sys.exit(SKIPPED)
    return path


def run(*command):
    result = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, universal_newlines=True)
    if result.returncode != 0:
        sys.exit(f'{" ".join(command)}: exit status {result.returncode}\n{result.stderr}')


def compare(name, limits, evaluation):
    """The line that says it all, and what is broken."""
    figures, broken = [], []
    for limit_key, key, label, more in MEASURES:
        if limit_key not in limits:
            continue
        value, limit = evaluation[key], limits[limit_key]
        digits = '.3f' if more else 'd'
        text = 'undefined' if value is None else format(value, digits)
        figures.append(f'{label} {text} ({"at least" if more else "at most"} {limit:{digits}})')
        if value is None or (value < limit if more else value > limit):
            broken.append(f'{name}: {label} {text}: the limit of {limit:{digits}} is broken')
    return f'{name}: ' + ', '.join(figures), broken


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('set', help='name of a data set of accuracy_limits.yaml')
    parser.add_argument('--sks', required=True, help='the command line')
    parser.add_argument('--folder', required=True, help='of codebooks and results')
    parser.add_argument('--train', action='store_true', help='make the codebook of this data set')
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    config = ['--config', os.path.join(HERE, '..', 'config', 'default.yaml')]
    if options.train:
        run(options.sks, 'train', '--dataset', data_set(options.set), '--output',
            os.path.join(options.folder, options.set + '.sks'), *config)
        return 0
    with open(os.path.join(HERE, 'accuracy_limits.yaml'), encoding='utf-8') as file:
        limits = yaml.safe_load(file).get(options.set)
    if limits is None:
        sys.exit(f'accuracy_limits.yaml has no data set {options.set}')
    result = os.path.join(options.folder, options.set + '.json')
    run(options.sks, 'evaluate', '--dataset', data_set(options.set), '--codebook',
        os.path.join(options.folder, limits['codebook'] + '.sks'), *config, '--json', result)
    with open(result, encoding='utf-8') as file:
        line, broken = compare(options.set, limits, json.load(file))
    print(line)
    with open(os.path.join(options.folder, options.set + '.txt'), 'w', encoding='utf-8') as file:
        file.write(line + '\n')
    for problem in broken:
        print(problem)
    return 1 if broken else 0


if __name__ == '__main__':
    sys.exit(main())
