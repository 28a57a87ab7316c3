// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <dynamic_reconfigure/Config.h>
#include <ros/callback_queue.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sks_detector/DetectionArray.h>
#include <sks_detector/Status.h>

namespace sks_detector {

/// What the panel hears from a node. May be made and destroyed, which asks the master, in any thread; receive() is
/// called in one, and calls the functions from there.
struct NodeTopics {
  explicit NodeTopics(const std::string& node);
  ~NodeTopics();
  NodeTopics(const NodeTopics&) = delete;
  NodeTopics& operator=(const NodeTopics&) = delete;

  /// Passes on what has come since the last call.
  void receive() { queue.callAvailable(ros::WallDuration(0)); }

  ros::CallbackQueue queue;
  std::function<void(const Status&)> on_status;
  std::function<void(const DetectionArray&, ros::Time received)> on_detections;
  std::function<void(double)> on_threshold;
  ros::NodeHandle handle;
  ros::Subscriber status, detections, parameters;
};

/// The parameter of dynamic_reconfigure that is the lowest score of a detection.
extern const char* const threshold_parameter;

/// Calls `use` with that parameter if a message has it.
void readThreshold(const dynamic_reconfigure::Config& config, const std::function<void(double)>& use);

}  // namespace sks_detector
