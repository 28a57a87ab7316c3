#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Several processes of `sks` under mpirun give what one gives, and end with one message where one of them fails.
Arguments: sks. Exit status 77 where there is no mpirun, or sks was built without MPI."""
import glob
import hashlib
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import yaml

SKS = os.path.abspath(sys.argv[1])
REPRODUCE = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), 'scripts', 'reproduce')
SCENES = 5
SECONDS = 240  # most that one run may take
FAST = ['--set', 'threads=1', '--set', 'keypoints.grid_size=0.03']

TABLES = '''name: tables
units: m
max_distance: 0.05
training:
  - {object: table, cloud: scenes/scene000.pcd, kind: view}
  - {object: desk, cloud: scenes/scene001.pcd, kind: view}
'''


def command(processes, arguments):
    if processes == 0:
        return [SKS] + arguments
    as_root = ['--allow-run-as-root'] if os.geteuid() == 0 else []
    return (['mpirun'] + as_root + ['--oversubscribe', '--bind-to', 'none', '-n', str(processes), SKS] + arguments)


def run(processes, *arguments):
    return subprocess.run(command(processes, list(arguments)), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=SECONDS)


def messages(run):
    return [line for line in run.stderr.splitlines() if line.startswith('sks: ')]


def without_times(value):
    if isinstance(value, dict):
        left_out = ('time_ms', 'peak_memory_mb', 'relative_time', 'seconds')
        return {key: without_times(item) for key, item in value.items() if key not in left_out}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def content(path):
    with open(path, 'rb') as file:
        return file.read()


def checksums(folder):
    files = sorted(path for path in glob.glob(folder + '/**', recursive=True) if os.path.isfile(path))
    return {os.path.relpath(path, folder): hashlib.sha256(content(path)).hexdigest() for path in files}


class ClusterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.set = os.path.join(cls.folder, 'set')
        cls.simulate(cls.set, 0)
        cls.checksums = checksums(cls.set)
        cls.codebook = os.path.join(cls.folder, 'mug.sks')
        done = run(0, 'train', '--mesh', 'mug=builtin:mug', 'duck=builtin:duck', '--views', '8', *FAST, '--output',
                   cls.codebook)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @staticmethod
    def simulate(folder, processes):
        done = run(processes, 'simulate', '--mesh', 'mug=builtin:mug', 'duck=builtin:duck', '--scenes', str(SCENES),
                   '--objects', '2', '--output', folder)
        assert done.returncode == 0, done.stderr

    def path(self, name):
        return os.path.join(self.folder, name)

    def checked(self, processes, *arguments):
        done = run(processes, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_simulates_the_same_files(self):
        for processes in (2, 4):
            other = self.path('set%d' % processes)
            self.simulate(other, processes)
            self.assertEqual(checksums(other), self.checksums)

    def test_reproduces_the_same_figures(self):
        with open(self.set + '/dataset.yaml') as file:
            data_set = yaml.safe_load(file)
        data_set['scenes'] = data_set['scenes'][:1]
        one_scene = os.path.join(self.set, 'one.yaml')
        with open(one_scene, 'w') as file:
            yaml.safe_dump(data_set, file)
        self.addCleanup(os.remove, one_scene)
        figures = {}
        for processes in (1, 2):
            results = self.path('results%d' % processes)
            done = subprocess.run([REPRODUCE, one_scene, '--sks', SKS, '--methods', 'sks', '--processes', str(processes),
                                   '--threads', '1', '--results', results, '--output', results + '/page.md'],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, timeout=SECONDS,
                                  env={key: value for key, value in os.environ.items() if key != 'SKS_DATA'})
            self.assertEqual(done.returncode, 0, done.stderr)
            figures[processes] = {os.path.basename(path): without_times(json.loads(content(path)))
                                  for path in glob.glob(results + '/*.json')}
            self.assertIn('; %d process' % processes, content(results + '/page.md').decode())
        self.assertGreaterEqual(len(figures[1]), 4)  # without and with selection
        self.assertEqual(figures[1], figures[2])

    def test_trains_the_same_codebook(self):
        files = {}
        for processes in (0, 1, 2, 4):
            name = self.path('all%d.sks' % processes)
            self.checked(processes, 'train', '--dataset', self.set + '/dataset.yaml', '--views', '8', *FAST, '--output',
                         name)
            files[processes] = content(name)
        for processes in (1, 2, 4):
            self.assertEqual(files[processes], files[0], processes)

    def test_trains_the_same_where_some_clouds_have_no_colour(self):
        for index in (2, 3):
            cloud = content('%s/scenes/scene%03d.pcd' % (self.set, index))
            self.assertIn(b'rgb', cloud[:300])
            with open(self.set + '/plain%d.pcd' % index, 'wb') as file:
                file.write(cloud.replace(b'rgb', b'abc', 1))
        clouds = ['scenes/scene000.pcd', 'plain2.pcd', 'scenes/scene001.pcd', 'scenes/scene004.pcd', 'plain3.pcd']
        with open(self.set + '/mixed.yaml', 'w') as file:
            file.write('name: mixed\nunits: m\nmax_distance: 0.05\ntraining:\n' + ''.join(
                '  - {object: thing%d, cloud: %s, kind: view}\n' % item for item in enumerate(clouds)))
        files = {}
        for processes in (0, 2, 4):
            name = self.path('mixed%d.sks' % processes)
            self.checked(processes, 'train', '--dataset', self.set + '/mixed.yaml', *FAST, '--output', name)
            files[processes] = content(name)
        for processes in (2, 4):
            self.assertEqual(files[processes], files[0], processes)

    def test_registers_captured_views_to_the_same_model(self):
        clouds = [('a', 0), ('a', 1), ('b', 0), ('b', 0), ('b', 0)]  # the same view again fits itself
        with open(self.set + '/captured.yaml', 'w') as file:
            file.write('name: captured\nunits: m\nmax_distance: 0.05\ntraining:\n' + ''.join(
                '  - {object: %s, cloud: scenes/scene%03d.pcd, kind: view}\n' % cloud for cloud in clouds))
        files, registrations = {}, {}
        for processes in (0, 2):
            name = self.path('captured%d.sks' % processes)
            done = self.checked(processes, 'train', '--dataset', self.set + '/captured.yaml', *FAST, '--set',
                                'training.register_views=true', '--output', name, '--json', '-')
            files[processes] = content(name)
            registrations[processes] = json.loads(done.stdout)['registration']
        self.assertEqual([thing['tied'] for thing in registrations[0]], [0, 3])
        self.assertEqual(registrations[2], registrations[0])
        self.assertEqual(files[2], files[0])

    def results(self, processes, *arguments):
        return without_times(json.loads(self.checked(processes, *arguments, *FAST, '--json', '-').stdout))

    def test_evaluates_to_the_same_results(self):
        arguments = ('evaluate', '--dataset', self.set + '/dataset.yaml', '--views', '8')
        alone = self.results(0, *arguments)
        self.assertEqual(len(alone['per_scene']), SCENES)
        self.assertTrue(any(scene['detections'] for scene in alone['per_scene']))
        for processes in (1, 2, 4):
            self.assertEqual(self.results(processes, *arguments), alone, processes)

    def test_classifies_to_the_same_results(self):
        with open(self.set + '/tests.yaml', 'w') as file:
            file.write(TABLES + 'tests:\n' + ''.join(
                '  - {object: table, cloud: scenes/scene%03d.pcd}\n' % i for i in range(SCENES)))
        arguments = ('classify', '--dataset', self.set + '/tests.yaml')
        alone = self.results(0, *arguments)
        for processes in (2, 4):
            self.assertEqual(self.results(processes, *arguments), alone, processes)

    def test_compares_keypoints_to_the_same_results(self):
        pose = '[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]'
        with open(self.set + '/keypoints.yaml', 'w') as file:
            file.write(TABLES + 'scenes:\n' + ''.join(
                '  - name: s%d\n    cloud: scenes/scene%03d.pcd\n    objects:\n      - {object: table, position: '
                '[0, 0, 1], reference: scenes/scene000.pcd, pose: %s}\n' % (i, i, pose) for i in range(3)))
        arguments = ('keypoints', '--dataset', self.set + '/keypoints.yaml')
        alone = self.results(0, *arguments)
        for processes in (2, 4):
            self.assertEqual(self.results(processes, *arguments), alone, processes)

    def test_names_file_and_machine_where_a_process_fails(self):
        damaged = self.path('damaged')
        shutil.copytree(self.set, damaged)
        with open(damaged + '/scenes/scene003.pcd', 'r+b') as file:
            file.truncate(5000)
        for processes in (2, 4):
            done = run(processes, 'evaluate', '--dataset', damaged + '/dataset.yaml', '--codebook', self.codebook, *FAST,
                       '--json', self.path('damaged.json'))
            self.assertEqual(done.returncode, 1, done.stderr)
            said = messages(done)
            self.assertEqual(len(said), 1, done.stderr)
            self.assertIn('scene003.pcd', said[0])
            self.assertRegex(said[0], r'\(process \d on %s\)' % socket.gethostname())
            self.assertFalse(os.path.exists(self.path('damaged.json')))

    def test_goes_on_where_a_run_was_ended(self):
        damaged = self.path('resumed')
        shutil.copytree(self.set, damaged)
        arguments = ['evaluate', '--dataset', damaged + '/dataset.yaml', '--codebook', self.codebook, *FAST, '--json',
                     self.path('resumed.json')]
        whole = without_times(json.loads(self.checked(0, *arguments[:-1], '-').stdout))
        journal = self.path('resumed.json.journal')
        for processes in (0, 2):
            with open(damaged + '/scenes/scene003.pcd', 'r+b') as file:
                cloud = file.read()
                file.truncate(5000)
            self.assertEqual(run(processes, *arguments, '--resume').returncode, 1)
            with open(damaged + '/scenes/scene003.pcd', 'wb') as file:
                file.write(cloud)
            known = content(journal).decode().splitlines()
            self.assertTrue(all(re.match('[0-9a-f]{8} [012] ', line) for line in known[1:]), known)
            other = run(0, *arguments, '--resume', '--set', 'detection.threshold=0.1')
            self.assertEqual((other.returncode, 'is the journal of another run' in other.stderr), (2, True))
            self.checked(processes, *arguments, '--resume')
            with open(self.path('resumed.json')) as file:
                self.assertEqual(without_times(json.load(file)), whole)
            self.assertFalse(os.path.exists(journal))
        self.assertEqual(run(0, *arguments[:-1], '-', '--resume').returncode, 2)

    def test_says_once_what_is_wrong_with_the_arguments(self):
        for arguments, status, text in ((('train', '--output', 'a.sks', '--nonsense'), 2, '--nonsense'),
                                        (('train', '--builtin', '--output', 'a.sks', '--set', 'thread=1'), 2, 'threads'),
                                        (('evaluate', '--dataset', '/gone.yaml'), 1, '/gone.yaml'),
                                        (('info', 'a.sks'), 2, 'does not share its work')):
            done = run(3, *arguments)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertEqual(len(messages(done)), 1, done.stderr)
            self.assertIn(text, messages(done)[0])

    def test_leaves_nothing_half_written_where_it_is_ended(self):
        folder = self.path('ended')
        os.mkdir(folder)
        process = subprocess.Popen(
            command(2, ['train', '--builtin', '--views', '300', '--output', folder + '/a.sks', '--set', 'threads=1']),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(3)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertNotEqual(process.wait(timeout=60), 0)
        self.assertEqual(os.listdir(folder), [])

    def test_loads_no_mpi_without_mpirun(self):
        libraries = subprocess.check_output(['ldd', SKS], universal_newlines=True)
        self.assertNotIn('libsks_detector_mpi', libraries)


if __name__ == '__main__':
    if shutil.which('mpirun') is None:
        print('there is no mpirun: apt-get install openmpi-bin')
        sys.exit(77)
    if 'cannot share' in run(2, 'evaluate', '--dataset', '/gone.yaml').stderr:
        print('sks was built without MPI')
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
