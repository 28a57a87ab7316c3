#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts that check the source, on small checkouts of their own, and the comparison with the limits of accuracy."""
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), 'scripts')
ORDER = '# Page\n\n```text include-order\nsrc/core/low\nsrc/core/high\nsrc/tools\n```\n'
TABLE = '# Page\n\n| section | stage folder | files | paper |\n| --- | --- | --- | --- |\n'


class Checkout(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, path, text=''):
        path = os.path.join(self.folder.name, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)

    def check(self, script):
        """Exit status and output."""
        run = subprocess.run([sys.executable, os.path.join(SCRIPTS, script), '--root', self.folder.name],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        return run.returncode, run.stdout

    def refused(self, script, *texts):
        status, output = self.check(script)
        self.assertEqual(status, 1, output)
        for text in texts:
            self.assertIn(text, output)
        return output


class Includes(Checkout):
    def setUp(self):
        super().setUp()
        self.write('docs/architecture.md', ORDER)
        self.write('include/sks_detector/cloud.hpp', '#include <vector>\n')
        self.write('src/core/low/low.hpp', '#include <sks_detector/cloud.hpp>\n#include <pcl/point_types.h>\n')
        self.write('src/core/high/high.hpp', '#include "core/low/low.hpp"\n')
        self.write('src/core/high/high.cpp', '#include "core/high/high.hpp"\n#include <vector>\n')
        self.write('src/tools/main.cpp', '#include "core/high/high.hpp"\n')

    def test_with_the_flow_are_accepted(self):
        status, output = self.check('check_includes.py')
        self.assertEqual(status, 0, output)
        self.assertIn('5 files follow the order of 3 folders', output)

    def test_against_the_flow_are_named(self):
        self.write('src/core/low/low.cpp', '\n  #  include "core/high/high.hpp"\n')
        output = self.refused('check_includes.py', 'src/core/low/low.cpp:2: includes src/core/high/high.hpp: '
                              'src/core/high comes after src/core/low in docs/architecture.md')
        self.assertIn('1 includes against the order', output)

    def test_in_angle_brackets_or_from_beside_are_seen(self):
        self.write('src/core/low/low.cpp', '#include <tools/tool.hpp>\n#include "../high/high.hpp"\n')
        self.write('src/tools/tool.hpp')
        self.refused('check_includes.py', 'low.cpp:1: includes src/tools/tool.hpp', 'low.cpp:2: includes src/core/high')

    def test_of_the_source_in_public_headers_are_refused(self):
        self.write('include/sks_detector/cloud.hpp', '#include "core/low/low.hpp"\n')
        self.refused('check_includes.py', 'include/sks_detector/cloud.hpp:1: includes src/core/low/low.hpp')

    def test_need_every_folder_in_the_list(self):
        self.write('src/viewer/viewer.cpp')
        self.refused('check_includes.py', 'src/viewer/viewer.cpp: is in no folder of the list')

    def test_need_the_list_and_its_folders(self):
        self.write('docs/architecture.md', ORDER.replace('src/tools', 'src/tols'))
        self.refused('check_includes.py', 'lists src/tols, which is not there')
        self.write('docs/architecture.md', '# Page\n')
        self.refused('check_includes.py', 'has no block ```text include-order')
        os.remove(os.path.join(self.folder.name, 'docs/architecture.md'))
        self.refused('check_includes.py', 'docs/architecture.md is missing')


class MethodTable(Checkout):
    def setUp(self):
        super().setUp()
        for name in ('normals.hpp', 'normals.cpp', 'grid.cpp'):
            self.write('src/core/surface/' + name)
        self.write('include/sks_detector/surface.hpp')

    def test_of_what_exists_is_accepted(self):
        self.write('docs/method.md', TABLE +
                   '| 2 Surface | `src/core/surface/` | `normals.cpp`, `grid.cpp` | 3.1 |\n'
                   '| 3 More | `src/core/surface/` | `normals.{hpp,cpp}`, `include/sks_detector/surface.hpp` | eq. 2 |\n'
                   '\n| 4 Another table | `nowhere/` | `nothing.cpp` | |\n')
        status, output = self.check('check_method_table.py')
        self.assertEqual(status, 0, output)
        self.assertIn('2 rows, 0 problems', output)

    def test_names_the_row_of_what_is_missing(self):
        self.write('docs/method.md', TABLE +
                   '| 2 Surface | `src/core/surface/` | `normals.cpp`, `gird.cpp` | 3.1 |\n'
                   '| [3 Voting](#3-voting) | `src/core/voting/` | `grid.cpp` | 3.2 |\n'
                   '| 4 Braces | `src/core/surface` | `grid.{hpp,cpp}` | |\n'
                   '| 5 Empty | | | |\n')
        output = self.refused('check_method_table.py',
                              'docs/method.md:5: row "2 Surface": there is no file gird.cpp in src/core/surface',
                              'docs/method.md:6: row "3 Voting": there is no folder src/core/voting',
                              'docs/method.md:7: row "4 Braces": there is no file grid.hpp in src/core/surface',
                              'docs/method.md:8: row "5 Empty" names no stage folder')
        self.assertNotIn('normals', output)

    def test_must_be_there(self):
        self.write('docs/method.md', '# Method\n\n| setting | default |\n| --- | --- |\n| a | b |\n')
        self.refused('check_method_table.py', 'has no table with the columns section | stage folder | files | paper')


class Accuracy(Checkout):
    """With a command line that gives what it is told to."""

    def compare(self, name, figures, data=True):
        self.write('data/kinect_few_views/dataset.yaml')
        self.write('data/clutter/dataset.yaml')
        self.write('sks', '#!/bin/sh\nfor last; do :; done\necho "$FIGURES" >"$last"\n')
        sks = os.path.join(self.folder.name, 'sks')
        os.chmod(sks, 0o755)
        environment = dict(os.environ, FIGURES=figures, SKS_DATA=os.path.join(self.folder.name, 'data') if data else '')
        run = subprocess.run([sys.executable, os.path.join(os.path.dirname(SCRIPTS), 'test', 'accuracy_test.py'), name,
                              '--sks', sks, '--folder', self.folder.name], env=environment,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
        return run.returncode, run.stdout

    def test_that_reaches_the_limits_passes_and_says_the_figures(self):
        status, output = self.compare(
            'kinect_few_views', '{"f1": 0.999, "average_precision": 0.998, "false_positives": 0}')
        self.assertEqual(status, 0, output)
        self.assertRegex(output, r'^kinect_few_views: F1 0.999 \(at least 0.\d+\), AP 0.998 \(at least 0.\d+\), '
                                 r'false alarms 0 \(at most \d+\)\n$')
        status, output = self.compare('clutter', '{"f1": null, "average_precision": null, "false_positives": 0}')
        self.assertEqual(status, 0, output)

    def test_fails_naming_each_limit_that_is_broken(self):
        status, output = self.compare(
            'kinect_few_views', '{"f1": 0.5, "average_precision": null, "false_positives": 100}')
        self.assertEqual(status, 1, output)
        for text in ('F1 0.500: the limit of', 'AP undefined: the limit of', 'false alarms 100: the limit of'):
            self.assertIn('kinect_few_views: ' + text, output)
        status, output = self.compare(
            'kinect_few_views', '{"f1": 0.999, "average_precision": 0.3, "false_positives": 0}')
        self.assertEqual(status, 1, output)
        self.assertEqual(output.count('is broken'), 1)

    def test_is_skipped_without_data(self):
        self.assertEqual(self.compare('kinect_few_views', '{}', data=False),
                         (77, 'skipped: SKS_DATA, the folder of the recorded data sets, is not set\n'))
        status, output = self.compare('lm_clutter', '{}')
        self.assertEqual(status, 77)
        self.assertIn('lm_clutter/dataset.yaml is not there', output)


if __name__ == '__main__':
    unittest.main()
