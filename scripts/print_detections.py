#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the detections in the results of `sks evaluate --json FILE` beside the truth."""
import json
import math
import sys


def place(position):
    return '  '.join(f'{value:7.3f}' for value in position) if position else 23 * ' ' + '  '


def rows(scene, threshold):
    """(object, true position or None, detection or None); each truth takes its true positive."""
    found = [d for d in scene['detections'] if d['score'] >= threshold]
    for truth in scene['ground_truth']:
        hits = [d for d in found if d['true_positive'] and d['object'] == truth['object']]
        hits.sort(key=lambda d: math.dist(d['position'], truth['position']))
        hit = hits[0] if hits else None
        if hit:
            found.remove(hit)
        yield truth['object'], truth['position'], hit
    for detection in found:
        yield detection['object'], None, detection


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: print_detections.py FILE')
    with open(sys.argv[1], encoding='utf-8') as file:
        result = json.load(file)
    for scene in result['per_scene']:
        print(f"\n{scene['name']}\n{'object':<18}{'true x, y, z [m]':<27}{'found x, y, z [m]':<27}score")
        for name, truth, hit in rows(scene, result['threshold']):
            score = f"{hit['score']:.2f}" if hit else 'missed'
            note = '' if truth else '  false alarm'
            print(f"{name:<18}{place(truth):<27}{place(hit and hit['position']):<27}{score}{note}")
    print()


if __name__ == '__main__':
    main()
