#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The template of the Debian packages, filled in, agrees with package.xml and with what is in the checkout; the scripts explain
themselves. The packages are built and tried by scripts/package and scripts/test_package."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
PACKAGE = xml.etree.ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
VERSION = PACKAGE.find('version').text
TIME = 1500000000  # [s]: Fri, 14 Jul 2017


def read(*path):
    with open(os.path.join(ROOT, *path), encoding='utf-8') as file:
        return file.read()


def output(*command):
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    return run.returncode, run.stdout


class Template(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.checkout = os.path.join(folder.name, 'checkout')
        os.makedirs(self.checkout)
        for name in ('package.xml', 'LICENSE'):
            shutil.copy(os.path.join(ROOT, name), self.checkout)
        shutil.copytree(os.path.join(ROOT, 'packaging'), os.path.join(self.checkout, 'packaging'))
        self.debian = os.path.join(folder.name, 'debian')

    def fill(self):
        return output(sys.executable, os.path.join(self.checkout, 'packaging', 'fill_template.py'), self.debian, str(TIME))

    def filled(self, name):
        status, text = self.fill()
        self.assertEqual(status, 0, text)
        return read(self.debian, name)

    def packages(self):
        """The fields of each package."""
        parts = [re.sub(r'\n ', ' ', part) for part in self.filled('control').split('\n\n')]
        fields = [dict(line.split(': ', 1) for line in part.strip().splitlines()) for part in parts]
        return {part['Package']: part for part in fields if 'Package' in part}

    def test_version_maintainer_and_license_are_those_of_the_source(self):
        maintainer = PACKAGE.find('maintainer')
        changelog = self.filled('changelog')
        self.assertTrue(changelog.startswith('sks-detector (%s) ' % VERSION), changelog)
        self.assertIn(' -- %s <%s>  Fri, 14 Jul 2017' % (maintainer.text, maintainer.get('email')), changelog)
        for line in read('LICENSE').split('\n'):
            self.assertIn(line, self.filled('copyright'))

    def test_the_library_needs_no_ros(self):
        packages = self.packages()
        library = 'libsks-detector' + re.match(r'\d+\.\d+', VERSION).group()
        self.assertEqual(set(packages), {library, 'libsks-detector-dev', 'python3-sks-detector', 'ros-sks-detector'})
        for name in (library, 'libsks-detector-dev', 'python3-sks-detector'):
            self.assertNotRegex(packages[name]['Depends'], 'ros|nodelet|rviz')
            self.assertTrue(os.path.exists(os.path.join(self.debian, name + '.install')), name)

    def test_everything_needed_at_run_time_has_a_package(self):
        lines = [line.split() for line in read('packaging', 'debian_names').splitlines() if line and line[0] != '#']
        names = {line[0]: line[1:] for line in lines}
        package = self.packages()['ros-sks-detector']
        depends, recommends = (re.split(r', *', package[field]) for field in ('Depends', 'Recommends'))
        keys = [element.text for tag in ('depend', 'exec_depend') for element in PACKAGE.findall(tag)]
        self.assertEqual(set(keys), set(names))
        for key in keys:
            if names[key] != ['-']:
                self.assertIn(names[key][0], recommends if names[key][1:] == ['recommended'] else depends)

    def test_a_key_without_a_package_is_named(self):
        text = read(self.checkout, 'package.xml').replace('</package>', '<exec_depend>warp_drive</exec_depend></package>')
        with open(os.path.join(self.checkout, 'package.xml'), 'w', encoding='utf-8') as file:
            file.write(text)
        status, message = self.fill()
        self.assertEqual(status, 1, message)
        self.assertIn('package.xml names warp_drive, which packaging/debian_names does not have', message)
        self.assertFalse(os.path.exists(self.debian))

    def test_headers_are_in_the_package_for_developers(self):
        lines = self.filled('libsks-detector-dev.install').split()
        for folder in glob.glob(os.path.join(ROOT, 'include', 'sks_detector', '*', '')):
            self.assertIn('usr/include/sks_detector/' + os.path.basename(os.path.dirname(folder)), lines)


class Scripts(unittest.TestCase):
    def test_explain_themselves(self):
        for name, word in (('package', 'lintian'), ('test_package', 'demo.launch')):
            script = os.path.join(ROOT, 'scripts', name)
            status, text = output('bash', script, '--help')
            self.assertEqual(status, 0, text)
            self.assertTrue(text.startswith('scripts/' + name), text)
            self.assertIn(word, text)
            self.assertNotIn('set -', text)
            status, text = output('bash', script, '--banana')
            self.assertEqual(status, 2)
            self.assertIn('unknown option --banana; see scripts/%s --help' % name, text)

    def test_the_shell_takes_them(self):
        for path in glob.glob(os.path.join(ROOT, 'test', 'package', '*.sh')):
            self.assertEqual(output('bash', '-n', path), (0, ''))

    def test_the_image_is_made_of_the_packages(self):
        self.assertIn('RUN scripts/package /packages\n', read('Dockerfile'))
        ignored = read('.dockerignore').split()
        self.assertLessEqual({'.git', 'build'}, set(ignored))
        self.assertFalse({'packaging', 'scripts', 'src', 'package.xml', 'CHANGELOG.rst'} & set(ignored))


if __name__ == '__main__':
    unittest.main()
