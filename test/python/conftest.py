# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the Python module share: a simulated data set and a codebook trained on it. SKS_EXECUTABLE is the
command line, which they are compared with; SKS_PYTHON_PATH is the folder of the module."""
import json
import os
import subprocess
import sys

import pytest

if "SKS_PYTHON_PATH" in os.environ:
    folder = os.environ["SKS_PYTHON_PATH"]
    sys.path.insert(0, folder)
    os.environ["PYTHONPATH"] = os.pathsep.join([folder] + os.environ.get("PYTHONPATH", "").split(os.pathsep))

import sks_detector  # noqa: E402

OBJECTS = ["mug", "duck", "drill"]


class Simulated:
    """Two scenes with three objects each, as files."""

    def __init__(self, folder):
        self.folder = str(folder)
        meshes = ["--mesh=%s=builtin:%s" % (name, name) for name in OBJECTS]
        self.run("simulate", *meshes, "--scenes", "2", "--objects", "3", "--distractors", "0",
                 "--max-distance", "0.9", "-o", self.folder)
        self.dataset = self.path("dataset.yaml")
        self.scenes = [self.path("scenes", "scene%03d.pcd" % i) for i in range(2)]

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def run(self, *arguments):
        run = subprocess.run([os.environ["SKS_EXECUTABLE"], *arguments], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, universal_newlines=True, check=False, timeout=120)
        assert run.returncode == 0, run.stderr
        return run.stdout

    def json(self, *arguments):
        return json.loads(self.run(*arguments, "--json", "-"))


@pytest.fixture(scope="session")
def simulated(tmp_path_factory):
    return Simulated(tmp_path_factory.mktemp("simulated") / "set")


@pytest.fixture(scope="session")
def codebook(simulated):
    return sks_detector.train(simulated.dataset)


@pytest.fixture(scope="session")
def codebook_file(simulated, codebook):
    path = simulated.path("toys.sks")
    codebook.save(path)
    return path
