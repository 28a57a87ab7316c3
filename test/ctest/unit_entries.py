#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Entries of ctest for a program of GoogleTest: one for each of its source files, so that not every case is a process of
its own. Cases that skip themselves (GTEST_SKIP) are entries of their own, since ctest knows no skipped part of an entry;
so are suites SlowX, which run only with SKS_SLOW=1, and AccuracyX, which evaluate recorded data on all cores. `--check`
compares an earlier list with the cases there are."""
import argparse
import fnmatch
import json
import os
import re
import subprocess
import sys
import tempfile

SKIPPED = r'\\[  SKIPPED \\]'


class Case:
    """A test case with where it stands."""

    def __init__(self, suite, case):
        self.suite, self.name, self.file, self.line = suite, case['name'], case['file'], int(case['line'])

    def full_name(self):
        return self.suite + '.' + self.name

    def kind(self):
        """The suite as the source has it: without the names of what instantiates it."""
        return re.sub(r'^.*/(?=[A-Za-z])', '', self.suite)


def list_cases(program, environment):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'list.json')
        subprocess.run(['env'] + ([environment] if environment else []) +
                       [program, '--gtest_list_tests', '--gtest_output=json:' + path],
                       stdout=subprocess.DEVNULL, check=True)
        with open(path, encoding='utf-8') as file:
            suites = json.load(file)['testsuites']
    return [Case(suite['name'], case) for suite in suites for case in suite['testsuite']]


def skips_itself(case, lines):
    """Whether the case says so between its line and the next case."""
    end = next((i for i in range(case.line, len(lines)) if re.match(r'(TYPED_)?TEST(_[FP])?\(', lines[i])), len(lines))
    return any('SKIP' in line for line in lines[case.line:end])


def entries(cases, sources, prefix):
    """(name, filter of GoogleTest, kind) of each entry; a suite that is spread over two files cannot be named by one."""
    paths = {os.path.basename(source): source for source in sources}
    if len(paths) != len(sources):
        sys.exit(f'{prefix}: two test files have the same name; give one another')
    files, home = {}, {}
    for case in cases:
        name = os.path.basename(case.file)
        if home.setdefault(case.suite, name) != name:
            sys.exit(f'{prefix}: the suite {case.suite} is in {home[case.suite]} and in {name}: give one another name')
        files.setdefault(name, []).append(case)
    for name, held in sorted(files.items()):
        with open(paths[name], encoding='utf-8') as file:
            lines = file.read().splitlines()
        stem = re.sub(r'(_test)?\.cpp$', '', name)
        alone = {}
        for case in held:
            if case.kind().startswith('Slow'):
                alone.setdefault(('slow.' + stem, 'slow'), []).append(case.suite + '.*')
            elif case.kind().startswith('Accuracy'):
                alone.setdefault(('accuracy.' + stem, 'accuracy'), []).append(case.suite + '.*')
            elif skips_itself(case, lines):
                single = re.sub(r'/.*$', '', case.name)
                alone.setdefault((f'{prefix}.{stem}.{single}', 'skips'), []).append(case.full_name())
        for (entry, kind), filters in alone.items():
            yield entry, ':'.join(dict.fromkeys(filters)), kind
        excluded = [f for filters in alone.values() for f in dict.fromkeys(filters)]
        suites = list(dict.fromkeys(c.suite + '.*' for c in held if not matches(c, ':'.join(excluded))))
        if suites:
            without = [f for f in excluded if f not in suites and f[:f.index('.')] + '.*' in suites]
            yield f'{prefix}.{stem}', ':'.join(suites) + ('-' + ':'.join(without) if without else ''), 'all'


def matches(case, filters):
    positive, _, negative = filters.partition('-')

    def any_of(patterns):
        return any(fnmatch.fnmatchcase(case.full_name(), p) for p in patterns.split(':') if p)
    return any_of(positive) and not any_of(negative)


def quoted(text):
    return '[==[' + text + ']==]'


def write(path, program, options, found):
    lines = []
    for name, filters, kind in found:
        command, label = [program, '--gtest_filter=' + filters], options.label
        properties = f'TIMEOUT {options.timeout}'
        if options.environment:
            properties += f' ENVIRONMENT {quoted(options.environment)}'
        if kind in ('skips', 'accuracy'):
            properties += f' SKIP_REGULAR_EXPRESSION "{SKIPPED}"'
        if kind == 'accuracy':
            properties += ' PROCESSORS 2'
            label = 'accuracy'
        if kind == 'slow':
            command = [options.slow_runner] + command
            properties += ' SKIP_RETURN_CODE 77'
            label = 'slow'
        lines.append(f'add_test({quoted(name)} {" ".join(map(quoted, command))})\n'
                     f'set_tests_properties({quoted(name)} PROPERTIES LABELS {label} {properties})\n')
    with open(path, 'w', encoding='utf-8') as file:
        file.write(''.join(lines))


def check(path, cases):
    """Each case is run by one entry, and by no other."""
    with open(path, encoding='utf-8') as file:
        filters = re.findall(r'--gtest_filter=(.*?)\]==\]', file.read())
    status = 0
    for case in cases:
        count = sum(matches(case, f) for f in filters)
        if count != 1:
            print(f'{case.full_name()} is run by {count} entries of ctest')
            status = 1
    print(f'{len(cases)} cases in {len(filters)} entries')
    return status if cases else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--program', required=True)
    parser.add_argument('--entries', required=True, help='file of CMake commands that is written, or checked')
    parser.add_argument('--check', action='store_true')
    parser.add_argument('--prefix', help='of the names of the entries')
    parser.add_argument('--label', default='unit')
    parser.add_argument('--timeout', type=int, default=600, help='[s]')
    parser.add_argument('--environment', default='', help='NAME=VALUE for the program')
    parser.add_argument('--slow-runner', help='command before slow tests')
    parser.add_argument('--sources', nargs='*', default=[])
    options = parser.parse_args()
    cases = list_cases(options.program, options.environment)
    if options.check:
        return check(options.entries, cases)
    write(options.entries, options.program, options, list(entries(cases, options.sources, options.prefix)))
    return 0


if __name__ == '__main__':
    sys.exit(main())
