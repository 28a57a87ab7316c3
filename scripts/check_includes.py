#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fails where an include runs against the order of the folders. The order stands in docs/architecture.md, in the block
`include-order`: one folder a line, lowest first. A folder may include itself and those above its line; the public headers
in include/ include nothing of src/."""
import argparse
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LIST = 'docs/architecture.md'
PUBLIC = 'include/sks_detector'
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def read_order(root):
    path = os.path.join(root, LIST)
    if not os.path.exists(path):
        sys.exit(f'check_includes: {LIST} is missing: it holds the order of the folders')
    with open(path, encoding='utf-8') as file:
        block = re.search(r'^```text include-order\n(.*?)^```', file.read(), re.M | re.S)
    order = block.group(1).split() if block else []
    if not order:
        sys.exit(f'check_includes: {LIST} has no block ```text include-order with the folders, lowest first')
    for folder in order:
        if not os.path.isdir(os.path.join(root, folder)):
            sys.exit(f'check_includes: {LIST} lists {folder}, which is not there')
    return order


def sources(root):
    """Paths from the root."""
    for top in ('include', 'src'):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in sorted(names):
                if name.endswith(('.hpp', '.cpp', '.h')):
                    yield os.path.relpath(os.path.join(folder, name), root)


def included(root, source):
    """(number of the line, path from the root) of each file of the checkout that a source includes."""
    with open(os.path.join(root, source), encoding='utf-8') as file:
        for number, line in enumerate(file, 1):
            match = INCLUDE.match(line)
            for base in (os.path.dirname(source), 'src', 'include') if match else ():
                path = os.path.normpath(os.path.join(base, match.group(1)))
                if os.path.exists(os.path.join(root, path)):
                    yield number, path
                    break


def level(path, order):
    """Its line of the list, from 1; 0 for public headers; None if it is in no folder of the list."""
    if path.startswith(PUBLIC + '/'):
        return 0
    holders = [folder for folder in order if path.startswith(folder + '/')]
    return order.index(max(holders, key=len)) + 1 if holders else None


def problems(root, order):
    for source in sources(root):
        own = level(source, order)
        if own is None:
            yield f'{source}: is in no folder of the list in {LIST}'
            continue
        for number, path in included(root, source):
            other = level(path, order)
            if other is not None and other > own:
                above = order[own - 1] if own else PUBLIC
                yield f'{source}:{number}: includes {path}: {order[other - 1]} comes after {above} in {LIST}'


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--root', default=ROOT, help='checkout (default: the one of this script)')
    root = parser.parse_args().root
    order = read_order(root)
    found = list(problems(root, order))
    for problem in found:
        print(problem)
    print(f'check_includes: {len(found)} includes against the order of {len(order)} folders' if found else
          f'check_includes: {sum(1 for _ in sources(root))} files follow the order of {len(order)} folders')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
