# SPDX-License-Identifier: BSD-3-Clause
"""The example is run as it is."""
import os
import re
import subprocess
import sys

import pytest

EXAMPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "python",
                       "detect_and_draw.py")


def run(*arguments):
    return subprocess.run([sys.executable, EXAMPLE, *map(str, arguments)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True, check=False, timeout=120)


def test_detect_and_draw(tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    picture = tmp_path / "out.png"
    done = run(picture, os.environ["SKS_EXECUTABLE"])
    assert done.returncode == 0, done.stderr
    lines = [line for line in done.stdout.splitlines() if " at [" in line]
    assert sorted(line.split()[0] for line in lines) == ["drill", "duck", "mug"]
    assert all(re.match(r"\w+ (1\.000|0\.[5-9]\d\d) at \[.*\] m$", line) for line in lines)
    image = pyplot.imread(str(picture))
    assert image.shape[:2] == (600, 800)
    for color in ((0x1f, 0x77, 0xb4), (0xff, 0x7f, 0x0e), (0x2c, 0xa0, 0x2c)):  # of the three boxes
        assert (abs(image[..., :3] * 255 - color) < 1.5).all(-1).sum() > 50


def test_says_what_is_missing(tmp_path):
    pytest.importorskip("matplotlib")
    done = run(tmp_path / "out.png", tmp_path / "no_such_program")
    assert done.returncode == 1 and "no_such_program" in done.stderr and "Traceback" not in done.stderr
