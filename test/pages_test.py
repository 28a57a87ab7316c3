#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What bash offers after some words, and whether the manual page holds all commands and options and passes the checks of
the manual programs that are there. Arguments: completion script, manual page, sks, source folder."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

COMPLETION, MANUAL, SKS, SOURCE = (os.path.abspath(path) for path in sys.argv[1:5])

# Splits a line as bash does, and prints what the function of the completion offers.
ASK = r'''
source "$1"; shift
compopt() { [[ $* == *nospace* ]] && echo "(nospace)" >&2; return 0; }
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
COMP_WORDS=("$@"); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); COMP_LINE="$*"
COMPREPLY=()
_sks "$PROGRAM" "${COMP_WORDS[COMP_CWORD]}"
printf '%s\n' "${COMPREPLY[@]}"
'''


def offered(line):
    words = [part for word in line.split(' ') for part in (re.split('(=)', word) if '=' in word else [word])]
    if line.endswith('='):
        words = words[:-1]  # nothing stands behind it yet
    environment = dict(os.environ, SKS_SHARE=SOURCE, PROGRAM=SKS)
    run = subprocess.run(['bash', '-c', ASK, 'bash', COMPLETION] + words, env=environment, check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
    if run.stderr.replace('(nospace)\n', ''):
        raise AssertionError(run.stderr)
    return [word for word in run.stdout.split('\n') if word]


def help_of(*words):
    return subprocess.run([SKS] + list(words) + ['--help'], check=True, stdout=subprocess.PIPE,
                          universal_newlines=True).stdout


COMMANDS = ['train', 'merge', 'detect', 'evaluate', 'classify', 'keypoints', 'import', 'simulate', 'info', 'verify',
            'settings']


class CompletionTest(unittest.TestCase):
    def test_subcommands(self):
        self.assertLessEqual(set(COMMANDS + ['bag']), set(offered('sks ')))
        self.assertEqual(offered('sks tr'), ['train'])
        self.assertEqual(offered('sks banana'), [])

    @unittest.skipUnless('bag' in help_of() and 'extract' in help_of('bag'), 'built without ROS')
    def test_subcommands_of_subcommands(self):
        self.assertEqual(sorted(offered('sks bag ')), ['evaluate', 'extract', 'info'])
        self.assertIn('--every', offered('sks bag extract --'))

    def test_all_options(self):
        for command in COMMANDS:
            there = set(re.findall(r'(?<![\w-])--[a-z][a-z-]*', help_of(command)))
            self.assertLessEqual({o for o in there if re.search(r'^\s+(-\w,)?%s\b' % o, help_of(command), re.M)},
                                 set(offered('sks %s --' % command)), command)
        self.assertEqual(offered('sks train --out'), ['--output'])
        self.assertIn('--force', offered('sks simulate --builtin --'))

    def test_methods_by_task(self):
        self.assertEqual(offered('sks evaluate --method '),
                         ['sks', 'sks-paper', 'grid', 'tombari', 'chen', 'aldoma', 'zhou'])
        self.assertEqual(offered('sks classify -d x.yaml -m k'), ['knopp'])
        self.assertEqual(offered('sks evaluate --method=to'), ['tombari'])

    def test_settings_and_their_values(self):
        keys = offered('sks train --set keypoints.')
        self.assertIn('keypoints.discard=', keys)
        self.assertTrue(all(key.startswith('keypoints.') for key in keys))
        self.assertIn('tombari.bin_size=', offered('sks evaluate --set tom'))
        self.assertEqual(offered('sks train --set keypoints.detector=i'), ['iss'])
        self.assertEqual(set(offered('sks train -s descriptor.type=')), {'auto', 'shot', 'cshot'})
        self.assertEqual(offered('sks train --set sanitize.crop=t'), ['true'])

    def test_presets(self):
        names = {os.path.basename(path) for path in offered('sks train --config ')}
        self.assertLessEqual({'default.yaml', 'fast.yaml', 'paper.yaml', 'classify.yaml', 'tombari.yaml'}, names)
        self.assertEqual([os.path.relpath(p, SOURCE) for p in offered('sks train -c pap')], ['config/paper.yaml'])

    def test_formats_come_before_folders(self):
        self.assertEqual(offered('sks import b'), ['bigbird', 'bop'])
        self.assertEqual(offered('sks import bop '), [])  # bash then offers files
        self.assertEqual(offered('sks import --units '), ['m', 'mm'])

    def test_the_shell_takes_the_script(self):
        subprocess.check_call(['bash', '-n', COMPLETION])
        with tempfile.TemporaryDirectory() as folder:  # an empty line of a shell that knows nothing yet
            subprocess.check_call(['bash', '--norc', '-c', 'set -u; source "$1"; complete -p sks', 'bash', COMPLETION],
                                  cwd=folder, stdout=subprocess.DEVNULL)


class ManualTest(unittest.TestCase):
    def text(self):
        with open(MANUAL, encoding='utf-8') as file:
            return file.read().replace('\\-', '-').replace('\\fB', '').replace('\\fI', '').replace('\\fR', '')

    def test_holds_all_commands_and_options(self):
        text = self.text()
        self.assertRegex(text, r'\.TH SKS 1 "\d{4}-\d{2}-\d{2}" "sks \d+\.\d+\.\d+"')
        for command in COMMANDS:
            part = re.search(r'\.SS sks %s\n(.*?)(?=\n\.S[SH])' % command, text, re.S)
            self.assertTrue(part, command)
            for option in offered('sks %s --' % command):
                self.assertIn(option, part.group(1), command)

    def test_passes_the_checks_that_are_there(self):
        if shutil.which('man'):
            run = subprocess.run(['man', '--warnings', '-E', 'UTF-8', '-l', '-Tutf8', '-Z', MANUAL],
                                 env=dict(os.environ, MANWIDTH='80', LC_ALL='C.UTF-8'), stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, universal_newlines=True)
            self.assertEqual((run.returncode, run.stderr), (0, ''))
        if shutil.which('mandoc'):
            run = subprocess.run(['mandoc', '-T', 'lint', '-W', 'warning', MANUAL], stdout=subprocess.PIPE,
                                 universal_newlines=True)
            self.assertEqual(run.stdout, '')


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
