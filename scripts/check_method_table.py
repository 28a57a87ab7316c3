#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fails where the table of the stages in docs/method.md (section | stage folder | files | paper) names a folder or a file
that does not exist. A folder is written as `src/core/surface/`, files as `normals.cpp` or `normals.{hpp,cpp}` in it, or with
their path from the root of the checkout."""
import argparse
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = 'docs/method.md'
COLUMNS = ['section', 'stage folder', 'files', 'paper']


def cells(line):
    return [cell.strip() for cell in line.strip().strip('|').split('|')]


def read_rows(text):
    """(number of the line, cells by column) of the first table with these columns; None if there is none."""
    lines = text.splitlines()
    for head, line in enumerate(lines):
        if line.lstrip().startswith('|') and [cell.lower() for cell in cells(line)] == COLUMNS:
            break
    else:
        return None
    rows = []
    for number in range(head + 2, len(lines)):
        if not lines[number].lstrip().startswith('|'):
            break
        rows.append((number + 1, dict(zip(COLUMNS, cells(lines[number])))))
    return rows


def names(cell):
    """What a cell has in backticks, {a,b} written out."""
    for text in re.findall(r'`([^`]+)`', cell):
        for name in re.split(r',\s*(?![^{]*})', text):
            braces = re.match(r'(.*){(.*)}(.*)$', name)
            yield from ([braces.group(1) + part.strip() + braces.group(3) for part in braces.group(2).split(',')]
                        if braces else [name.strip()])


def problems(root, rows):
    for number, row in rows:
        section = re.sub(r'\[([^]]*)\]\([^)]*\)', r'\1', row['section'])  # of a link its text
        place = f'{PAGE}:{number}: row "{section}"'
        folders = [folder.rstrip('/') for folder in names(row.get('stage folder', ''))]
        files = list(names(row.get('files', '')))
        if not folders:
            yield f'{place} names no stage folder'
        if not files:
            yield f'{place} names no file'
        for folder in folders:
            if not os.path.isdir(os.path.join(root, folder)):
                yield f'{place}: there is no folder {folder}'
        for name in files:
            paths = [os.path.join(folder, name) for folder in folders] + ([name] if '/' in name else [])
            if not any(os.path.isfile(os.path.join(root, path)) for path in paths):
                yield f'{place}: there is no file {name} in {" or ".join(folders) or "the checkout"}'


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--root', default=ROOT, help='checkout (default: the one of this script)')
    root = parser.parse_args().root
    with open(os.path.join(root, PAGE), encoding='utf-8') as file:
        rows = read_rows(file.read())
    if not rows:
        print(f'check_method_table: {PAGE} has no table with the columns {" | ".join(COLUMNS)}')
        return 1
    found = list(problems(root, rows))
    for problem in found:
        print(problem)
    print(f'check_method_table: {len(rows)} rows, {len(found)} problems')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
