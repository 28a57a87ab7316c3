#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the folder debian/ of a Debian source tree from the template beside this script: version, maintainer and what is
needed at run time come from package.xml, the text of the license from LICENSE. Arguments: folder to write, time of the
release [s since 1970]."""
import email.utils
import os
import re
import shutil
import sys
import xml.etree.ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
RUN_TIME_TAGS = ('depend', 'exec_depend')


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def debian_names():
    """Key of package.xml to [package of Debian, or - where none is needed], or [package, 'recommended']."""
    lines = [line.split() for line in read(os.path.join(HERE, 'debian_names')).splitlines()]
    return {line[0]: line[1:] for line in lines if line and line[0] != '#'}


def run_time_packages(package, names):
    """What is depended on, and what is recommended."""
    keys = [element.text for tag in RUN_TIME_TAGS for element in package.findall(tag)]
    unknown = sorted(set(keys) - set(names))
    if unknown:
        sys.exit('fill_template.py: package.xml names %s, which packaging/debian_names does not have: add the package of '
                 'Debian, or -' % ', '.join(unknown))
    return (sorted({names[key][0] for key in keys if len(names[key]) == 1} - {'-'}),
            sorted({names[key][0] for key in keys if names[key][1:] == ['recommended']}))


def field_text(text):
    """As the lines of a field of a control file."""
    return '\n'.join(' ' + (line or '.') for line in text.strip().splitlines())


def values(time):
    package = xml.etree.ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
    maintainer = package.find('maintainer')
    version = package.find('version').text
    depends, recommends = run_time_packages(package, debian_names())
    return {
        'VERSION': version,
        'SOVERSION': re.match(r'\d+\.\d+', version).group(),
        'MAINTAINER': '%s <%s>' % (maintainer.text, maintainer.get('email')),
        'DATE': email.utils.formatdate(time),
        'RUN_TIME_DEPENDS': ', '.join(depends),
        'RUN_TIME_RECOMMENDS': ', '.join(recommends),
        'LICENSE': field_text(read(os.path.join(ROOT, 'LICENSE'))),
    }


def fill(text, fields):
    return re.sub('@([A-Z_]+)@', lambda match: fields[match.group(1)], text)


def main():
    if len(sys.argv) != 3:
        sys.exit('usage: fill_template.py FOLDER TIME')
    folder, time = sys.argv[1], int(sys.argv[2])
    fields = values(time)
    template = os.path.join(HERE, 'debian')
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    for name in sorted(os.listdir(template)):
        source, target = os.path.join(template, name), os.path.join(folder, fill(name, fields))
        with open(target, 'w', encoding='utf-8') as file:
            file.write(fill(read(source), fields))
        shutil.copymode(source, target)


if __name__ == '__main__':
    main()
