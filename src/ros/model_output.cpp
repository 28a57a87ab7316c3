// SPDX-License-Identifier: BSD-3-Clause
#include "ros/model_output.hpp"

#include <ros/time.h>

#include "ros/model_message.hpp"

namespace sks_detector {

ModelOutput::ModelOutput(ros::NodeHandle& private_handle, const DetectorSlot& slot) : slot_(slot) {
  publisher_ = private_handle.advertise<ObjectModels>(
      "models", 1, [this](const ros::SingleSubscriberPublisher&) { subscribed(); }, ros::SubscriberStatusCallback(),
      ros::VoidConstPtr(), true);
}

void ModelOutput::codebookChanged() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (wanted_) publish();
}

void ModelOutput::subscribed() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (wanted_) return;  // roscpp has sent what is latched
  wanted_ = true;
  publish();
}

void ModelOutput::publish() {
  ObjectModels message;
  if (const auto detector = slot_.detector()) {
    message = toModels(detector->codebook(), nameWithChecksum(detector->codebook()));
  }
  message.header.stamp = ros::Time::now();
  publisher_.publish(message);
}

}  // namespace sks_detector
