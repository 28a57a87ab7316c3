#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that each C++ snippet of README.md and docs/ stands in examples/, which is built and run by tests.

A line `<!-- examples/FILE -->` before the fence names the file; the snippet is consecutive lines of it, whatever their
indentation."""
import glob
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def stripped(text):
    return [line.strip() for line in text.strip().splitlines()]


def contains(lines, part):
    return any(lines[i:i + len(part)] == part for i in range(len(lines) - len(part) + 1))


def faults(path):
    """Of one document: (line, what is wrong)."""
    with open(path) as file:
        lines = file.read().splitlines()
    for i, line in enumerate(lines):
        if line.strip() != "```cpp":
            continue
        before = next((text for text in reversed(lines[:i]) if text.strip()), "")
        named = re.match(r"\s*<!-- (examples/\S+) -->\s*$", before)
        if not named:
            yield i + 1, "a C++ snippet without a line <!-- examples/FILE --> before it"
            continue
        end = next((k for k in range(i + 1, len(lines)) if lines[k].strip() == "```"), None)
        if end is None:
            yield i + 1, "a C++ snippet that does not end"
            continue
        example = os.path.join(ROOT, named.group(1))
        if not os.path.isfile(example):
            yield i + 1, named.group(1) + " does not exist"
            continue
        with open(example) as file:
            source = stripped(file.read())
        snippet = stripped("\n".join(lines[i + 1:end]))
        if not snippet or not contains(source, snippet):
            yield i + 1, "the snippet is not in " + named.group(1)


def main():
    documents = sys.argv[1:] or [os.path.join(ROOT, "README.md")] + sorted(
        glob.glob(os.path.join(ROOT, "docs", "**", "*.md"), recursive=True))
    failed = False
    for path in documents:
        for line, fault in faults(path):
            print("%s:%d: %s" % (os.path.relpath(path), line, fault), file=sys.stderr)
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
