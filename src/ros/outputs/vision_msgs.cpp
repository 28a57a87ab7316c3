// SPDX-License-Identifier: BSD-3-Clause
// ~detections_3d, in the messages of vision_msgs as ROS Noetic has them.
#include <vision_msgs/Detection3DArray.h>

#include "ros/result_output.hpp"

namespace sks_detector {
namespace {

vision_msgs::Detection3DArray visionMessage(const DetectionArray& detections,
                                            const std::vector<std::uint32_t>& places) {
  vision_msgs::Detection3DArray message;
  message.header = detections.header;
  for (std::size_t i = 0; i < detections.detections.size(); ++i) {
    const Detection& detection = detections.detections[i];
    vision_msgs::ObjectHypothesisWithPose hypothesis;
    hypothesis.id = places.at(i);
    hypothesis.score = double(detection.score);
    hypothesis.pose = detection.pose;
    vision_msgs::Detection3D found;
    found.header = detections.header;
    found.results.push_back(hypothesis);
    found.bbox.center = detection.box_center;
    found.bbox.size = detection.box_size;
    message.detections.push_back(found);
  }
  return message;
}

const bool detections_enlisted = MessageOutput<vision_msgs::Detection3DArray>::enlist("detections_3d", visionMessage);

}  // namespace
}  // namespace sks_detector
