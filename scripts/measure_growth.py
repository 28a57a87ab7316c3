#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How time, memory and accuracy grow with the number of objects: trains codebooks of the first N meshes of data sets, filled up
with built-in objects and with variants of the meshes (larger and smaller, mirrored, in other colours), and detects in their
scenes. Prints a table; F1 of each data set whose objects are all trained, and of a codebook of its objects alone. Writes
growth.json for plot_growth.py. Needs python3-pil and python3-yaml."""
import argparse
import json
import os
import subprocess
import sys
import time

import yaml
from PIL import Image

BUILTIN = ('mug bottle bowl box drill duck dice ball matchbox spool pawn card coaster tile booklet tablet marker screwdriver '
           'brush spoon stick').split()
VARIANTS = [('small', 0.8, False), ('mirrored', 1, True), ('large', 1.25, False), ('mirrored_small', 0.9, True),
            ('mirrored_large', 1.15, True)]


def changed_obj(lines, scale, mirrored):
    """An OBJ file scaled and, where asked, mirrored at the plane x = 0."""
    sign = -1 if mirrored else 1
    for line in lines:
        words = line.split()
        if words and words[0] == 'v':
            x, y, z = (scale * float(word) for word in words[1:4])
            yield ' '.join([f'v {sign * x:.6f} {y:.6f} {z:.6f}'] + words[4:]) + '\n'
        elif words and words[0] == 'vn' and mirrored:
            yield f'vn {-float(words[1])} {words[2]} {words[3]}\n'
        elif words and words[0] == 'f' and mirrored:
            yield ' '.join(['f'] + words[:0:-1]) + '\n'
        else:
            yield line


def write_variant(mesh, folder, scale, mirrored):
    """Copies an OBJ mesh with its material, in other colours: the channels of its texture change places."""
    os.makedirs(folder, exist_ok=True)
    source = os.path.dirname(mesh)
    path = os.path.join(folder, os.path.basename(mesh))
    with open(mesh, encoding='utf-8') as old, open(path, 'w', encoding='utf-8') as new:
        new.writelines(changed_obj(old, scale, mirrored))
    for name in os.listdir(source):
        if name.endswith('.mtl'):
            with open(os.path.join(source, name), encoding='utf-8') as old, \
                    open(os.path.join(folder, name), 'w', encoding='utf-8') as new:
                new.write(old.read())
        elif name.endswith(('.png', '.jpg')):
            red, green, blue = Image.open(os.path.join(source, name)).convert('RGB').split()
            Image.merge('RGB', (green, blue, red)).save(os.path.join(folder, name))
    return path


class DataSet:
    """A data set file that trains meshes."""

    def __init__(self, path):
        with open(path, encoding='utf-8') as file:
            content = yaml.safe_load(file)
        self.path, self.name = path, content['name']
        folder = os.path.dirname(os.path.abspath(path))
        self.training = [dict(entry, cloud=os.path.join(folder, entry['cloud']), units=entry.get('units', content['units']))
                         for entry in content['training']]
        self.clouds = [os.path.join(folder, scene['cloud']) for scene in content['scenes']]
        self.objects = {entry['object'] for entry in self.training}


def entries(data_sets, output):
    """Training entries: the meshes of the data sets, then what is made up, as often as one asks for the next."""
    own = [entry for data_set in data_sets for entry in data_set.training]
    yield from own
    for name in BUILTIN:
        yield {'object': 'builtin_' + name, 'cloud': 'builtin:' + name, 'kind': 'mesh'}
    for name, scale, mirrored in VARIANTS:
        for entry in own:
            if entry['cloud'].endswith('.obj'):
                made = f'{name}_{entry["object"]}'
                mesh = write_variant(entry['cloud'], os.path.join(output, 'meshes', made), scale, mirrored)
                yield {'object': made, 'cloud': mesh, 'kind': 'mesh', 'units': entry['units']}


class Run:
    """A finished run of the command line: its seconds, CPU seconds and peak of memory [MB]."""

    def __init__(self, command):
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
        if status != 0:
            sys.exit('failed: ' + ' '.join(command))
        self.seconds = time.monotonic() - start
        self.cpu = usage.ru_utime + usage.ru_stime
        self.peak = usage.ru_maxrss * 1024 / 1e6  # it counts KiB


class Growth:
    def __init__(self, options, arguments):
        self._options, self._arguments = options, arguments

    def _path(self, name):
        return os.path.join(self._options.output, name)

    def _train(self, name, training):
        with open(self._path(name + '.yaml'), 'w', encoding='utf-8') as file:
            yaml.safe_dump({'name': f'growth_{name}', 'units': 'm', 'training': training}, file)
        return Run([self._options.sks, 'train', '--dataset', self._path(name + '.yaml'), '--output',
                    self._path(name + '.sks')] + self._arguments)

    def _detect(self, name, clouds):
        """The run, and the milliseconds of its frames."""
        times = self._path(name + '_times.json')
        run = Run([self._options.sks, 'detect', '--codebook', self._path(name + '.sks'), '--json', times] + self._arguments +
                  clouds)
        with open(times, encoding='utf-8') as file:
            return run, [cloud['time_ms']['total'] for cloud in json.load(file)['clouds']]

    def _score(self, name, data_set):
        scores = self._path(f'{name}_{data_set.name}.json')
        Run([self._options.sks, 'evaluate', '--dataset', data_set.path, '--codebook', self._path(name + '.sks'), '--json',
             scores] + self._arguments)
        with open(scores, encoding='utf-8') as file:
            result = json.load(file)
        return {key: result[key] for key in ('f1', 'average_precision', 'false_positives')}

    def alone(self, data_set):
        """What a codebook of a data set's objects alone scores in it."""
        self._train(data_set.name, data_set.training)
        return self._score(data_set.name, data_set)

    def row(self, training, data_sets):
        name, clouds, repeat = str(len(training)), data_sets[0].clouds, self._options.repeat
        trained = self._train(name, training)
        size = os.path.getsize(self._path(name + '.sks')) / 1e6
        # What loading takes is what the frame of a run does not.
        first, (answer,) = min((self._detect(name, clouds[:1]) for _ in range(repeat)), key=lambda run: run[0].seconds)
        # Of all scenes twice over the second time: what a frame takes of a detector that has seen some.
        once, _ = self._detect(name, clouds)
        twice, frames = self._detect(name, 2 * clouds)
        frames = sorted(frames[len(clouds):])
        objects = {entry['object'] for entry in training}
        return {'objects': len(training), 'file_mb': size, 'train_s': trained.seconds, 'train_cpu_s': trained.cpu,
                'train_mb': trained.peak, 'loading_s': first.seconds - answer / 1000, 'first_answer_s': first.seconds,
                'first_answer_cpu_s': first.cpu, 'first_mb': first.peak, 'detect_mb': twice.peak,
                'frame_ms': frames[len(frames) // 2], 'frame_p95_ms': frames[int(0.95 * (len(frames) - 1))],
                'frame_cpu_s': (twice.cpu - once.cpu) / len(clouds),
                'scores': {d.name: self._score(name, d) for d in data_sets if d.objects <= objects}}


def text(value):
    return f'{value:>12d}' if isinstance(value, int) else f'{value:>12.3f}'


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog='Other arguments go to sks: --set, --config.')
    parser.add_argument('--dataset', required=True, nargs='+',
                        help='data set files (YAML) that train meshes; frames are timed in the scenes of the first')
    parser.add_argument('--output', required=True, help='folder for meshes, codebooks and growth.json')
    parser.add_argument('--objects', type=int, nargs='+', default=[1, 5, 21, 80], help='default: 1 5 21 80')
    parser.add_argument('--repeat', type=int, default=3, help='first answers, of which the fastest counts (default: 3)')
    parser.add_argument('--sks', default='sks', help='the command line (default: sks, from PATH)')
    options, arguments = parser.parse_known_args()
    data_sets = [DataSet(path) for path in options.dataset]
    if len(set().union(*(d.objects for d in data_sets))) < sum(len(d.objects) for d in data_sets):
        sys.exit('two of the data sets have an object of one name')
    options.output = os.path.abspath(options.output)
    os.makedirs(options.output, exist_ok=True)
    growth, made, source = Growth(options, arguments), [], entries(data_sets, options.output)
    result = {'rows': [], 'alone': {}}
    columns = ['objects', 'file_mb', 'train_s', 'train_cpu_s', 'train_mb', 'loading_s', 'first_answer_s', 'first_mb', 'detect_mb',
               'frame_ms', 'frame_p95_ms', 'frame_cpu_s']
    print(' '.join(f'{column:>12}' for column in [column.replace('_answer', '') for column in columns]))
    for count in options.objects:
        while len(made) < count:
            entry = next(source, None)
            if entry is None:
                sys.exit(f'there are only {len(made)} objects')
            made.append(entry)
        row = growth.row(made[:count], data_sets)
        result['rows'].append(row)
        print(' '.join(text(row[column]) for column in columns), flush=True)
        for name, score in row['scores'].items():
            print(f'  {name}: {score}', flush=True)
    for data_set in data_sets:
        result['alone'][data_set.name] = growth.alone(data_set)
        print(f'{data_set.name} alone: {result["alone"][data_set.name]}', flush=True)
    with open(os.path.join(options.output, 'growth.json'), 'w', encoding='utf-8') as file:
        json.dump(result, file, indent=2)


if __name__ == '__main__':
    main()
