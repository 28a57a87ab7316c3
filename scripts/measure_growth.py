#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How time, memory and accuracy grow with the number of objects: trains codebooks of the first N meshes of a data set, filled up
with built-in objects and with variants of the meshes (larger and smaller, mirrored, in other colours), and detects in its
scenes. Prints a table; F1 where all objects of the data set are trained. Needs python3-pil and python3-yaml."""
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


def entries(data_set, folder, output):
    """Training entries: the meshes of the data set, then what is made up, as often as one asks for the next."""
    own = [dict(entry, cloud=os.path.join(folder, entry['cloud'])) for entry in data_set['training']]
    yield from own
    for name in BUILTIN:
        yield {'object': 'builtin_' + name, 'cloud': 'builtin:' + name, 'kind': 'mesh'}
    for name, scale, mirrored in VARIANTS:
        for entry in own:
            if entry['cloud'].endswith('.obj'):
                made = f'{name}_{entry["object"]}'
                mesh = write_variant(entry['cloud'], os.path.join(output, 'meshes', made), scale, mirrored)
                yield {'object': made, 'cloud': mesh, 'kind': 'mesh'}


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
        self.peak = usage.ru_maxrss / 1024  # KiB


def measure(options, arguments, data_set, folder, count, training):
    path = os.path.join(options.output, f'{count}.yaml')
    with open(path, 'w', encoding='utf-8') as file:
        yaml.safe_dump({'name': f'growth_{count}', 'units': data_set['units'], 'training': training}, file)
    codebook = os.path.join(options.output, f'{count}.sks')
    trained = Run([options.sks, 'train', '--dataset', path, '--output', codebook] + arguments)
    clouds = [os.path.join(folder, scene['cloud']) for scene in data_set['scenes']]
    times = os.path.join(options.output, f'{count}_times.json')
    detect = [options.sks, 'detect', '--codebook', codebook, '--json', times] + arguments
    # What loading takes is what the frames of a run do not.
    first = min((Run(detect + clouds[:1]) for _ in range(options.repeat)), key=lambda run: run.seconds)
    with open(times, encoding='utf-8') as file:
        answer = json.load(file)['clouds'][0]['time_ms']['total'] / 1000
    once, thrice = Run(detect + clouds), Run(detect + 3 * clouds)
    row = {'objects': count, 'file_mb': os.path.getsize(codebook) / 1e6, 'train_s': trained.seconds, 'train_cpu_s': trained.cpu,
           'train_mb': trained.peak, 'first_answer_s': first.seconds, 'loading_s': first.seconds - answer, 'first_mb': first.peak,
           'frame_cpu_s': (thrice.cpu - once.cpu) / (2 * len(clouds))}
    with open(times, encoding='utf-8') as file:
        totals = sorted(cloud['time_ms']['total'] for cloud in json.load(file)['clouds'])
    row['frame_ms'] = totals[len(totals) // 2]
    trained_objects = {entry['object'] for entry in training}
    if all(entry['object'] in trained_objects for entry in data_set['training']):
        scores = os.path.join(options.output, f'{count}_scores.json')
        Run([options.sks, 'evaluate', '--dataset', options.dataset, '--codebook', codebook, '--json', scores] + arguments)
        with open(scores, encoding='utf-8') as file:
            result = json.load(file)
        row.update(f1=result['f1'], average_precision=result['average_precision'],
                   false_positives=result['false_positives'])
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog='Other arguments go to sks: --set, --config.')
    parser.add_argument('--dataset', required=True, help='data set file (YAML) that trains meshes')
    parser.add_argument('--output', required=True, help='folder for meshes, codebooks and growth.json')
    parser.add_argument('--objects', type=int, nargs='+', default=[1, 5, 21, 80], help='default: 1 5 21 80')
    parser.add_argument('--repeat', type=int, default=3, help='first answers, of which the fastest counts (default: 3)')
    parser.add_argument('--sks', default='sks', help='the command line (default: sks, from PATH)')
    options, arguments = parser.parse_known_args()
    with open(options.dataset, encoding='utf-8') as file:
        data_set = yaml.safe_load(file)
    folder = os.path.dirname(os.path.abspath(options.dataset))
    options.output = os.path.abspath(options.output)
    os.makedirs(options.output, exist_ok=True)
    made, source, rows = [], entries(data_set, folder, options.output), []
    columns = ['objects', 'file_mb', 'train_s', 'train_cpu_s', 'train_mb', 'loading_s', 'first_answer_s', 'first_mb', 'frame_ms',
               'frame_cpu_s', 'f1', 'average_precision', 'false_positives']
    print(' '.join(f'{column:>14}' for column in columns))
    for count in options.objects:
        while len(made) < count:
            entry = next(source, None)
            if entry is None:
                sys.exit(f'there are only {len(made)} objects')
            made.append(entry)
        rows.append(measure(options, arguments, data_set, folder, count, made[:count]))
        cells = [rows[-1].get(column) for column in columns]
        print(' '.join(f'{"-":>14}' if cell is None else f'{cell:14.3f}' if isinstance(cell, float) else f'{cell:14d}'
                       for cell in cells), flush=True)
        with open(os.path.join(options.output, 'growth.json'), 'w', encoding='utf-8') as file:
            json.dump(rows, file, indent=2)


if __name__ == '__main__':
    main()
