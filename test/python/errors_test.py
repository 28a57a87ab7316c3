# SPDX-License-Identifier: BSD-3-Clause
"""Whatever is wrong raises sks_detector.Error with a message that names it."""
import numpy as np
import pytest
import sks_detector
from sks_detector import Error

POINTS = np.zeros((12, 3), np.float32)


def raised(code, *texts):
    class Checked:
        def __enter__(self):
            self.context = pytest.raises(Error)
            self.info = self.context.__enter__()

        def __exit__(self, *exception):
            result = self.context.__exit__(*exception)
            assert self.info.value.code == code
            for text in texts:
                assert text in str(self.info.value)
            return result
    return Checked()


def test_error_is_a_runtime_error():
    assert issubclass(Error, RuntimeError)
    assert Error.__module__ == "sks_detector"


def test_files(tmp_path):
    with raised("bad_file", "none.sks"):
        sks_detector.Detector(tmp_path / "none.sks")
    with raised("bad_file", "none.sks"):
        sks_detector.Codebook.load(str(tmp_path / "none.sks"))
    (tmp_path / "text.sks").write_text("not a codebook")
    with raised("bad_file", "text.sks"):
        sks_detector.Codebook.load(tmp_path / "text.sks")
    with raised("bad_file", "none.pcd"):
        sks_detector.read_cloud(tmp_path / "none.pcd")
    with raised("bad_usage", "scale"):
        sks_detector.read_cloud(tmp_path / "none.pcd", scale=0)
    with raised("bad_file", "none.yaml"):
        sks_detector.train(tmp_path / "none.yaml")
    with raised("bad_file", "none.yaml"):
        sks_detector.evaluate(tmp_path / "none.yaml")
    with pytest.raises(TypeError):
        sks_detector.Codebook.load(3)


def test_codebook_is_not_written_elsewhere(codebook, tmp_path):
    with raised("bad_usage", "toys.txt"):
        codebook.save(tmp_path / "toys.txt")
    with raised("bad_file", "nowhere"):
        codebook.save(tmp_path / "nowhere" / "toys.sks")


@pytest.mark.parametrize("points, texts", [
    (np.zeros((4, 2)), ["(N, 3)", "(4, 2)"]),
    (np.zeros(3), ["(N, 3)"]),
    (np.zeros((2, 2, 2, 3)), ["(2, 2, 2, 3)"]),
    (np.zeros((4, 3), np.int16), ["int16", "0.001"]),
    (np.zeros((4, 3), complex), ["complex128"]),
    ("points", ["points"]),
    (None, ["points"]),
])
def test_points(codebook, points, texts):
    with raised("bad_usage", *texts):
        sks_detector.Detector(codebook).detect(points)


def test_colors_width_and_origin():
    with raised("bad_usage", "colors", "uint8", "float32"):
        sks_detector.Cloud(POINTS, colors=POINTS)
    with raised("bad_usage", "colors", "(12, 3)", "(11, 3)"):
        sks_detector.Cloud(POINTS, colors=np.zeros((11, 3), np.uint8))
    with raised("bad_usage", "width 5", "12"):
        sks_detector.Cloud(POINTS, width=5)
    with raised("bad_usage", "width 5", "4 columns"):
        sks_detector.Cloud(POINTS.reshape(3, 4, 3), width=5)
    with raised("bad_usage", "sensor_origin"):
        sks_detector.Cloud(POINTS, sensor_origin=[1, 2])
    with raised("bad_usage", "Cloud"):
        sks_detector.Cloud(sks_detector.Cloud(POINTS), width=4)
    with pytest.raises(TypeError):
        sks_detector.Cloud(POINTS, width=-1)


def test_unusable_clouds(codebook):
    detector = sks_detector.Detector(codebook)
    for points in (POINTS[:0], np.full((100, 3), np.nan)):
        with raised("bad_data"):
            detector.detect(points)


def test_settings(codebook, tmp_path):
    for settings, texts in [
            ({"keypoints.discrad": 0.5}, ["keypoints.discrad", "keypoints.discard"]),
            ({"keypoints.discard": 7}, ["keypoints.discard"]),
            ({"keypoints": {"discard": [1]}}, ["keypoints.discard", "list"]),
            ({"threads": None}, ["threads", "NoneType"]),
            ({3: 4}, ["3"])]:
        with raised("bad_usage", *texts):
            sks_detector.Detector(codebook, settings=settings)
        with raised("bad_usage", *texts):
            sks_detector.train(meshes={"mug": "builtin:mug"}, settings=settings)
    with raised("incompatible", "descriptor.radius"):
        sks_detector.Detector(codebook, settings={"descriptor.radius": 0.033})
    (tmp_path / "s.yaml").write_text("keypoints: {discard: 2}\n")
    with raised("bad_usage", "s.yaml", "keypoints.discard"):
        sks_detector.Detector(codebook, settings=tmp_path / "s.yaml")
    (tmp_path / "s.yaml").write_text("detection: {threshold: 0.9}\n")
    assert sks_detector.Detector(codebook, settings=tmp_path / "s.yaml").settings["detection.threshold"] == 0.9


def test_nothing_to_train():
    with raised("bad_usage", "nothing to train"):
        sks_detector.train()
    with raised("bad_usage", "nothing to train"):
        sks_detector.train([])
    with raised("bad_usage", "Sample", "int"):
        sks_detector.train([1])
    with raised("bad_usage", "kind", "side"):
        sks_detector.Sample("mug", POINTS, kind="side")
    with raised("bad_usage", "name"):
        sks_detector.Sample("", POINTS)
