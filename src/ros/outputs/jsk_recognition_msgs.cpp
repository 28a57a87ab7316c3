// SPDX-License-Identifier: BSD-3-Clause
// ~boxes, in the messages of jsk_recognition_msgs.
#include <jsk_recognition_msgs/BoundingBoxArray.h>

#include "ros/result_output.hpp"

namespace sks_detector {
namespace {

jsk_recognition_msgs::BoundingBoxArray boxesMessage(const DetectionArray& detections,
                                                    const std::vector<std::uint32_t>& places) {
  jsk_recognition_msgs::BoundingBoxArray message;
  message.header = detections.header;
  for (std::size_t i = 0; i < detections.detections.size(); ++i) {
    const Detection& detection = detections.detections[i];
    jsk_recognition_msgs::BoundingBox box;
    box.header = detections.header;
    box.pose = detection.box_center;
    box.dimensions = detection.box_size;
    box.value = detection.score;
    box.label = places.at(i);
    message.boxes.push_back(box);
  }
  return message;
}

const bool boxes_enlisted = MessageOutput<jsk_recognition_msgs::BoundingBoxArray>::enlist("boxes", boxesMessage);

}  // namespace
}  // namespace sks_detector
