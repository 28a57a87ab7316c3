# SPDX-License-Identifier: BSD-3-Clause
"""Detections of the Python module: those of the command line, in whatever form the cloud is given."""
import threading

import numpy as np
import pytest
import sks_detector


def same(detections, others):
    assert len(detections) == len(others) > 0
    for one, other in zip(detections, others):
        assert (one.object, one.score, one.votes, one.inliers) == (other.object, other.score, other.votes, other.inliers)
        np.testing.assert_array_equal(one.T_scene_model, other.T_scene_model)


def test_detections_are_those_of_the_command_line(simulated, codebook_file):
    detector = sks_detector.Detector(codebook_file)
    for scene in simulated.scenes:
        expected = simulated.json("detect", "-b", codebook_file, scene)["clouds"][0]["detections"]
        found = detector.detect(sks_detector.read_cloud(scene))
        assert len(found) == len(expected) >= 2
        for d, e in zip(found, expected):
            assert (d.object, d.view, d.votes, d.inliers) == (e["object"], e["view"], e["votes"], e["inliers"])
            assert d.score == pytest.approx(e["score"], abs=1e-12)
            np.testing.assert_allclose(d.T_scene_model, np.reshape(e["pose"], (4, 4)), atol=1e-12)
            np.testing.assert_allclose(d.box_center[:3, 3], e["box"]["center"], atol=1e-12)
            np.testing.assert_allclose(d.position, e["position"], atol=1e-12)
            np.testing.assert_allclose(d.box_size, e["box"]["size"], atol=1e-12)
            np.testing.assert_allclose(d.box_center[:3, :3] @ d.box_center[:3, :3].T, np.eye(3), atol=1e-6)
            assert d.object in repr(d)


def test_every_form_of_the_same_cloud_gives_the_same(simulated, codebook):
    detector = sks_detector.Detector(codebook)
    cloud = sks_detector.read_cloud(simulated.scenes[0])
    columns = cloud.points.shape[1]
    expected = detector.detect(cloud)
    same(detector.detect(cloud.points, cloud.colors), expected)
    same(detector.detect(cloud.points.reshape(-1, 3), cloud.colors.reshape(-1, 3), width=columns), expected)
    same(detector.detect(cloud.points.astype(np.float64), cloud.colors), expected)
    same(detector.detect(np.asfortranarray(cloud.points), np.asfortranarray(cloud.colors)), expected)
    same(detector.detect(np.repeat(cloud.points, 2, axis=1)[:, ::2], cloud.colors), expected)
    unorganized = detector.detect(cloud.points.reshape(-1, 3))
    assert sorted(d.object for d in unorganized) == sorted(d.object for d in expected)


def test_cloud_shares_its_memory_and_outlives_its_owner(simulated):
    cloud = sks_detector.read_cloud(simulated.scenes[0])
    assert cloud.organized and len(cloud) == cloud.points.size // 3
    assert np.shares_memory(cloud.points, cloud.points) and not cloud.points.flags.writeable
    assert cloud.points.dtype == np.float32 and cloud.colors.dtype == np.uint8
    points, copy = cloud.points, cloud.points.copy()
    del cloud
    np.testing.assert_array_equal(points, copy)
    made = sks_detector.Cloud(copy, sensor_origin=(0, 0.5, 1))
    copy[:] = 0  # the cloud has a copy of its own
    np.testing.assert_array_equal(made.points, points)
    assert made.colors is None and list(made.sensor_origin) == [0, 0.5, 1]


def test_settings_and_threshold(simulated, codebook):
    cloud = sks_detector.read_cloud(simulated.scenes[0])
    usual = sks_detector.Detector(codebook)
    assert usual.settings["detection.threshold"] > 0 and usual.objects == codebook.objects
    every = usual.detect(cloud, threshold=0)
    scores = [d.score for d in every]
    assert scores == sorted(scores, reverse=True)
    assert len([s for s in scores if s >= usual.settings["detection.threshold"]]) == len(usual.detect(cloud))
    flat = sks_detector.Detector(codebook, settings={"detection.threshold": scores[0], "threads": 1})
    nested = sks_detector.Detector(codebook, settings={"detection": {"threshold": repr(scores[0])}})
    same(flat.detect(cloud), every[:1])
    same(nested.detect(cloud), every[:1])
    assert flat.settings["threads"] == 1


def test_objects_may_have_thresholds_of_their_own(simulated, codebook):
    cloud = sks_detector.read_cloud(simulated.scenes[0])
    usual = sks_detector.Detector(codebook).detect(cloud)
    name = usual[0].object
    without = sks_detector.Detector(codebook, settings={"detection.threshold": 0, "detection.thresholds": name + "=1"})
    every = without.detect(cloud, threshold=0)
    same(without.detect(cloud), [d for d in every if d.object != name or d.score >= 1])
    assert any(d.object == name and d.score < 1 for d in every)
    with pytest.warns(UserWarning, match="'nothing' is not in the codebook"):
        sks_detector.Detector(codebook, settings={"detection.thresholds": "nothing=0.5"})
    with pytest.raises(sks_detector.Error, match="object=score"):
        sks_detector.Detector(codebook, settings={"detection.thresholds": name})


def test_threads_share_a_detector(simulated, codebook):
    detector = sks_detector.Detector(codebook, settings={"threads": 1})
    clouds = [sks_detector.read_cloud(scene) for scene in simulated.scenes]
    expected = [detector.detect(cloud) for cloud in clouds]
    found = [None] * 4

    def work(i):
        found[i] = detector.detect(clouds[i % 2])

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
        assert not thread.is_alive()
    for i in range(4):
        same(found[i], expected[i % 2])


def test_others_run_while_it_detects(simulated, codebook):
    """The GIL is free: a thread that only counts gets ahead during one call."""
    detector = sks_detector.Detector(codebook, settings={"threads": 1})
    cloud = sks_detector.read_cloud(simulated.scenes[0])
    inside, done, ticks = threading.Event(), threading.Event(), []

    def count():
        inside.set()
        while not done.wait(0.001):
            ticks.append(None)

    thread = threading.Thread(target=count)
    thread.start()
    assert inside.wait(10)
    before = len(ticks)
    detector.detect(cloud)
    during = len(ticks) - before
    done.set()
    thread.join(10)
    assert during >= 3
