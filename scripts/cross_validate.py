#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy of `sks classify` on the training clouds of a data set alone, to choose settings without looking at its
tests: each fold leaves every n-th training cloud of each object out of training and classifies it."""
import argparse
import collections
import json
import os
import subprocess
import sys
import tempfile

import yaml


def fold(data_set, folder, number, count):
    """The data set of one fold: what is left out of training is what is tested; paths become absolute."""
    seen = collections.Counter()
    training, tests = [], []
    for entry in data_set['training']:
        entry = dict(entry, cloud=os.path.join(folder, entry['cloud']))
        left_out = seen[entry['object']] % count == number
        seen[entry['object']] += 1
        if left_out:
            tests.append({'object': entry['object'], 'cloud': entry['cloud']})
        else:
            training.append(entry)
    return {'name': data_set['name'], 'units': data_set['units'], 'training': training, 'tests': tests}


def classify(sks, data_set, arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'fold.yaml')
        with open(path, 'w', encoding='utf-8') as file:
            yaml.safe_dump(data_set, file)
        run = subprocess.run([sks, 'classify', '--dataset', path, '--json', '-'] + arguments, stdout=subprocess.PIPE)
        if run.returncode != 0:
            sys.exit(run.returncode)
        return json.loads(run.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog='Other arguments go to sks classify: --set, --config.')
    parser.add_argument('--dataset', required=True, help='data set file (YAML)')
    parser.add_argument('--folds', type=int, default=5, help='default: 5')
    parser.add_argument('--sks', default='sks', help='the command line (default: sks, from PATH)')
    options, arguments = parser.parse_known_args()
    with open(options.dataset, encoding='utf-8') as file:
        data_set = yaml.safe_load(file)
    folder = os.path.dirname(os.path.abspath(options.dataset))
    tests = correct = 0
    for number in range(options.folds):
        result = classify(options.sks, fold(data_set, folder, number, options.folds), arguments)
        tests += result['tests']
        correct += result['correct']
    print(f'{correct / tests:.3f} ({correct} of {tests}) {" ".join(arguments)}')


if __name__ == '__main__':
    main()
