#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What ~detect can be asked for besides a cloud: objects, a region, a threshold."""
import numpy as np
import rospy
import rostest
from dynamic_reconfigure.msg import Config, DoubleParameter, StrParameter
from dynamic_reconfigure.srv import Reconfigure
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, TransformStamped, Vector3
from rosgraph_msgs.msg import Log
from tf2_msgs.msg import TFMessage

import services_support
import support
import synthetic

QUARTER_TURN_ABOUT_Z = (0, 0, np.sqrt(0.5), np.sqrt(0.5))
T_TABLE_CAMERA = np.array([1, 2, 3])  # a translation [m]


def region(center, size, orientation=(0, 0, 0, 0), frame=""):
    """The fields of a request; metres."""
    pose = PoseStamped(pose=Pose(Point(*center), Quaternion(*orientation)))
    pose.header.frame_id = frame
    return {"roi_pose": pose, "roi_size": Vector3(*size)}


class DetectServiceTest(services_support.ServicesTest):
    def setUp(self):
        self.succeed("load_codebook", "synthetic.sks")
        self.cloud = support.cloud_message(synthetic.scene())
        self.thing, self.round = (synthetic.position(name) for name in ("thing", "round"))

    def detect(self, **fields):
        return self.succeed("detect", cloud=self.cloud, **fields).detections.detections

    def names(self, **fields):
        return sorted(d.object for d in self.detect(**fields))

    def refuse_request(self, *reasons, **fields):
        self.refuse("detect", *reasons, cloud=self.cloud, **fields)

    def set_parameter(self, name, value):
        wanted = DoubleParameter(name, value)
        reply = rospy.ServiceProxy("/detector/set_parameters", Reconfigure)(Config(doubles=[wanted]))
        self.assertIn(wanted, reply.config.doubles)

    def set_text(self, name, value, in_force=None):
        reply = rospy.ServiceProxy("/detector/set_parameters", Reconfigure)(Config(strs=[StrParameter(name, value)]))
        self.assertIn(StrParameter(name, value if in_force is None else in_force), reply.config.strs)

    def test_tells_only_of_the_objects_asked_for(self):
        self.assertEqual(self.names(objects=["round"]), ["round"])
        self.assertEqual(self.names(objects=["thing", "round"]), ["round", "thing"])
        whole = {d.object: d for d in self.detect()}
        self.assertEqual(sorted(whole), ["round", "thing"])
        self.assertEqual(self.detect(objects=["thing"]), [whole["thing"]])

    def test_refuses_unknown_objects_with_the_nearest(self):
        self.refuse_request("'rond'", "synthetic", "did you mean 'round'?", objects=["thing", "rond"])
        self.refuse_request("there are: thing, round", objects=["x"])

    def test_tells_only_of_a_region_of_the_clouds_frame(self):
        found = self.detect(**region(self.round, (0.05, 0.05, 0.05)))
        self.assertEqual([d.object for d in found], ["round"])
        np.testing.assert_allclose(support.position_of(found[0].box_center), self.round, atol=0.01)
        difference = np.linalg.inv(synthetic.model_pose("round")) @ support.matrix_of(found[0].pose.pose)
        self.assertLess(np.degrees(np.arccos(min(1, (np.trace(difference[:3, :3]) - 1) / 2))), 5)
        self.assertEqual(self.names(**region(self.thing, (0.05, 0.05, 0.05), frame="/camera")), ["thing"])
        beside = self.round + [0.08, 0, 0]  # in it are points of the object, but not its centre
        self.assertEqual(self.names(**region(beside, (0.1, 0.1, 0.1))), [])

    def test_regions_may_be_turned(self):
        between = (self.thing + self.round) / 2
        size = (0.5, 0.12, 0.3)
        self.assertEqual(self.names(**region(between, size)), ["round", "thing"])
        self.assertEqual(self.names(**region(between, size, QUARTER_TURN_ABOUT_Z)), [])
        self.assertEqual(self.names(**region(between, (0.12, 0.5, 0.3), QUARTER_TURN_ABOUT_Z)), ["round", "thing"])

    def test_regions_may_be_in_another_frame(self):
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "table", "camera"
        transform.transform.translation, transform.transform.rotation.w = Vector3(*T_TABLE_CAMERA), 1
        publisher = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        publisher.publish(TFMessage([transform]))
        at_round = region(self.round + T_TABLE_CAMERA, (0.05, 0.05, 0.05), frame="table")

        def known():
            reply = self.node.call("detect", cloud=self.cloud, **at_round)
            return reply.success and reply
        # the node begins to listen to /tf with the first request
        reply = support.wait_for(known, "the transform")
        self.assertEqual([d.object for d in reply.detections.detections], ["round"])
        self.assertEqual(reply.detections.header.frame_id, "camera")
        self.refuse_request("nowhere", "camera", **region((0, 0, 0), (1, 1, 1), frame="nowhere"))
        publisher.unregister()

    def test_a_region_where_nothing_is_holds_no_detections(self):
        self.assertEqual(self.names(**region((0, 0, -5), (0.1, 0.1, 0.1))), [])
        self.assertEqual(self.names(**region((1e7, 0, 0), (0.1, 0.1, 0.1))), [])
        empty = support.cloud_message(np.full((120, 160, 3), np.nan))
        self.refuse("detect", "19200 are NaN", cloud=empty, **region((0, 0, -5), (0.1, 0.1, 0.1)))

    def test_threshold_replaces_that_of_the_node(self):
        self.addCleanup(self.set_parameter, "verification.half_evidence", 1.7)
        self.set_parameter("verification.half_evidence", 20)  # scores that differ
        usual = self.detect()
        low = self.detect(threshold=1e-6)
        best = {name: max(d.score for d in low if d.object == name) for name in ("thing", "round")}
        self.assertEqual(usual, [d for d in low if d.score >= 0.5])
        between = sum(best.values()) / 2
        self.assertGreater(max(best.values()), between + 0.01)
        better = self.detect(threshold=between)
        self.assertEqual(better, [d for d in low if d.score >= between])
        self.assertEqual({d.object for d in better}, {max(best, key=best.get)})
        at_round = region(self.round, (0.05, 0.05, 0.05))
        self.assertEqual(set(self.names(threshold=1e-6, objects=["round"], **at_round)), {"round"})
        self.assertEqual(self.names(threshold=1e-6, objects=["thing"], **region(self.round, (1e-3, 1e-3, 1e-3))), [])

    def test_objects_may_have_thresholds_of_their_own(self):
        self.assertEqual(self.names(), ["round", "thing"])
        self.addCleanup(self.set_text, "detection.thresholds", "")
        self.addCleanup(self.set_parameter, "detection.threshold", 0.5)
        self.set_parameter("detection.threshold", 1)
        self.assertEqual(self.names(), [])
        self.set_text("detection.thresholds", "round=0.5")
        self.assertEqual(self.names(), ["round"])
        self.assertEqual(rospy.get_param("/detector/detection/thresholds"), "round=0.5")
        self.assertEqual(self.names(threshold=0.5), ["round", "thing"])  # of a request: for all objects
        log = support.Recorder("/rosout", Log)
        self.addCleanup(log.close)
        support.wait_for(log.connections, "the node's log")
        self.set_text("detection.thresholds", "rond=0.5")  # its codebook may be loaded later
        log.wait_for(lambda m: "'rond' is not in the codebook; did you mean 'round'?" in m.msg, "a warning")
        self.assertEqual(self.names(), [])
        for wrong in ("round", "round=2", "round=0.5,round=0.6"):
            self.set_text("detection.thresholds", wrong, in_force="rond=0.5")

    def test_refuses_numbers_that_make_no_sense(self):
        for threshold in (-0.1, 1.1, float("nan")):
            self.refuse_request("threshold", "0 to 1", threshold=threshold)
        for size in ((0.1, 0, 0.1), (-1, 1, 1), (1, float("nan"), 1), (float("inf"), 1, 1)):
            self.refuse_request("roi_size", " m: each edge must be greater than 0", **region((0, 0, 1), size))
        self.refuse_request("roi_pose", "not finite", **region((0, 0, float("nan")), (1, 1, 1)))
        self.refuse_request("roi_pose", "norm 2", "unit quaternion", **region((0, 0, 1), (1, 1, 1), (0, 0, 0, 2)))
        # before any cloud is waited for
        self.refuse("detect", "threshold", timeout=30, threshold=2)


if __name__ == "__main__":
    rospy.init_node("services_detect_test")
    rostest.rosrun("sks_detector", "services_detect", DetectServiceTest)
