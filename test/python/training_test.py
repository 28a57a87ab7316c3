# SPDX-License-Identifier: BSD-3-Clause
"""Training and evaluation of the Python module, beside those of the command line."""
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import sks_detector

MUG = {"mug": "builtin:mug"}


def test_codebook_is_that_of_the_command_line(simulated, codebook, codebook_file, tmp_path):
    other = str(tmp_path / "other.sks")
    simulated.run("train", "-d", simulated.dataset, "-o", other)
    with open(other, "rb") as one, open(codebook_file, "rb") as two:
        assert one.read() == two.read()
    read = sks_detector.Codebook.load(codebook_file)
    assert read.objects == codebook.objects == ["mug", "duck", "drill"]
    assert (read.name, read.views, read.descriptor) == ("simulated", 3 * 42, codebook.descriptor)
    assert read.codewords == codebook.codewords > 1000
    assert read.settings == codebook.settings
    assert "simulated" in repr(read)


def test_samples_are_what_is_found(simulated, codebook):
    """A view that was cut out of a scene is found where it was."""
    cloud = sks_detector.read_cloud(simulated.scenes[0])
    best = sks_detector.Detector(codebook).detect(cloud)[0]
    inside = (cloud.points.reshape(-1, 3) - best.position) @ best.box_center[:3, :3]
    with np.errstate(invalid="ignore"):
        part = cloud.points.reshape(-1, 3)[(np.abs(inside) <= best.box_size / 2).all(1)]
    trained = sks_detector.train([sks_detector.Sample("part", part, source="cut")], name="cut out")
    assert (trained.name, trained.objects, trained.views) == ("cut out", ["part"], 1)
    found = sks_detector.Detector(trained).detect(part)[0]
    assert (found.object, found.view) == ("part", "cut")
    np.testing.assert_allclose(found.T_scene_model, np.eye(4), atol=0.01)
    np.testing.assert_allclose(found.box_size, part.max(0) - part.min(0), atol=1e-5)


def test_progress_is_told_and_may_cancel():
    told = []
    sks_detector.train(meshes=MUG, views=4, progress=lambda *state: told.append(state))
    assert told[0] == ("training", "builtin:mug#0", 0, 4)
    assert told[-1][2:] == (4, 4)
    with pytest.raises(sks_detector.Error) as caught:
        sks_detector.train(meshes=MUG, views=4, progress=lambda stage, item, done, total: done < 2)
    assert caught.value.code == "cancelled" and "2 of 4" in str(caught.value)

    def fails(*_):
        raise LookupError("mine")
    with pytest.raises(LookupError, match="mine"):
        sks_detector.train(meshes=MUG, views=4, progress=fails)


def test_interrupt_ends_training():
    """A SIGINT while the core trains becomes KeyboardInterrupt between two clouds."""
    program = ("import os, signal, sks_detector\n"
               "def progress(stage, item, done, total):\n"
               "    print(done, flush=True)\n"
               "    if done == 1: os.kill(os.getpid(), signal.SIGINT)\n"
               "sks_detector.train(meshes={'mug': 'builtin:mug'}, views=1000, progress=progress)\n")
    run = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                         universal_newlines=True, check=False, timeout=60)
    assert "KeyboardInterrupt" in run.stderr
    assert run.returncode in (-signal.SIGINT, 130, 1)
    assert len(run.stdout.split()) <= 3


def test_old_names_are_warned_of():
    with pytest.warns(UserWarning, match="verification.ambiguity"):
        sks_detector.train(meshes=MUG, views=4, settings={"verification.ambiguity": 1})


def test_evaluation_is_that_of_the_command_line(simulated, codebook, codebook_file):
    expected = simulated.json("evaluate", "-d", simulated.dataset, "-b", codebook_file)
    result = sks_detector.evaluate(simulated.dataset, codebook)
    assert set(result) == set(expected)
    for key in set(expected) - {"time_ms", "peak_memory_mb", "per_scene"}:
        assert result[key] == expected[key], key
    assert result["scenes"] == 2 and result["recall"] > 0.5
    for one, other in zip(result["per_scene"], expected["per_scene"]):
        assert one["ground_truth"] == other["ground_truth"]
        assert one["detections"] == other["detections"]
    told = []
    trained = sks_detector.evaluate(simulated.dataset, progress=lambda *state: told.append(state[0]))
    assert trained["f1"] == result["f1"] and told[0] == "training"


def test_messages_of_ros_stay_what_they_are():
    """sks_detector.msg is found beside the module, and does not load its compiled part."""
    program = "import sys, sks_detector\n"
    if os.environ.get("SKS_MESSAGES"):
        program += ("from sks_detector.msg import Detection\nfrom sks_detector.srv import Train\n"
                    "assert Detection().score == 0 and Train._type == 'sks_detector/Train'\n")
    program += ("assert 'sks_detector._core' not in sys.modules and 'Detector' in dir(sks_detector)\n"
                "from sks_detector import *\nassert Detector.__name__ == 'Detector'\n"
                "assert 'sks_detector._core' in sys.modules and not hasattr(sks_detector, 'detector')\n")
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)
