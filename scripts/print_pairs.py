#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the pairs in the results of `sks_benchmarks --benchmark_out=FILE` as a table; exits with 1 where one falls short."""
import json
import sys


def row(result):
    """(cells of the table, whether the pair shows what it must)."""
    if result.get('error_occurred'):
        return [result['name'], '-', '-', '-', '-', result['error_message']], True
    accuracy, wanted = result.get('accuracy'), result.get('wanted_accuracy')
    good = result['ratio'] >= result['wanted_ratio'] and (accuracy is None or accuracy >= wanted)
    said = f"{accuracy:.4f} {result['label']}, wanted {wanted:g}" if accuracy is not None else result.get('label', '')
    return [result['name'], f"{result['theirs_ms']:.2f}", f"{result['ours_ms']:.2f}",
            f"{result['ratio']:.2f} (wanted {result['wanted_ratio']:g})", f"{result['cpu_ratio']:.2f}",
            said + ('' if good else '  << short')], good


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: print_pairs.py FILE')
    with open(sys.argv[1], encoding='utf-8') as file:
        results = json.load(file)['benchmarks']
    for result in results:
        result['name'] = result['name'].replace('/iterations:1', '').replace('/manual_time', '')
    rows = [row(result) for result in results if 'wanted_ratio' in result or result.get('error_occurred')]
    table = [['pair', 'theirs [ms]', 'ours [ms]', 'ratio', 'CPU time ratio', 'accuracy']] + [cells for cells, _ in rows]
    widths = [max(len(cells[column]) for cells in table) for column in range(5)]
    for cells in table:
        print('  '.join(cell.ljust(width) for cell, width in zip(cells, widths)) + '  ' + cells[5])
    sys.exit(0 if all(good for _, good in rows) else 1)


main()
