#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""~models: what the objects of the codebook look like, for displays."""
import numpy as np
import rospy
import rostest

import services_support
import support
import synthetic
from sks_detector.msg import DetectionArray, ObjectModels, Status


def names_of(message):
    return sorted(model.object for model in message.models)


class ModelsTest(services_support.ServicesTest):
    def listen(self):
        recorder = support.Recorder("/detector/models", ObjectModels)
        self.addCleanup(recorder.close)
        return recorder

    def test_who_comes_later_gets_them_at_once(self):
        self.succeed("load_codebook", "synthetic.sks")
        for _ in range(2):
            message = self.listen().wait_for()
            self.assertEqual(names_of(message), ["round", "thing"])
            self.assertIn("synthetic (", message.codebook)

    def test_tells_when_the_codebook_changes(self):
        self.succeed("load_codebook", "synthetic.sks")
        models = self.listen()
        models.wait_for(lambda m: names_of(m) == ["round", "thing"], "both")
        self.succeed("remove_object", object="round")
        models.wait_for(lambda m: names_of(m) == ["thing"], "what is left")
        self.succeed("load_codebook", "synthetic.sks")
        support.wait_for(lambda: names_of(models.messages[-1]) == ["round", "thing"], "both again")

    def test_models_lie_on_what_was_found(self):
        self.succeed("load_codebook", "synthetic.sks")
        models = self.listen().wait_for(lambda m: len(m.models) == 2)
        cloud = support.cloud_message(synthetic.scene())
        scene = support.points_of(cloud)
        scene = scene[np.isfinite(scene).all(1)]
        found = self.succeed("detect", cloud=cloud).detections.detections
        self.assertEqual(len(found), 2)
        for detection in found:
            model = next(m for m in models.models if (m.object, m.view) == (detection.object, detection.view))
            points = support.points_of(model.points)
            self.assertTrue(50 < len(points) <= 3000, len(points))
            self.assertAlmostEqual(model.spacing, 0.005)
            placed = synthetic.apply(support.matrix_of(detection.pose.pose), points.astype(float))
            gaps = [np.linalg.norm(scene - point, axis=1).min() for point in placed]
            self.assertLess(np.median(gaps), 0.004)

    def test_who_listens_only_to_models_makes_the_node_process_no_clouds(self):
        self.succeed("load_codebook", "synthetic.sks")
        self.listen().wait_for()
        status = support.Recorder("/detector/status", Status)
        self.addCleanup(status.close)
        self.assertEqual(status.wait_for().state, Status.READY)
        detections = support.Recorder("/detector/detections", DetectionArray)
        self.addCleanup(detections.close)
        status.wait_for(lambda m: m.state == Status.DETECTING, "a listener to detections")


if __name__ == "__main__":
    rospy.init_node("models_test")
    rostest.rosrun("sks_detector", "models", ModelsTest)
