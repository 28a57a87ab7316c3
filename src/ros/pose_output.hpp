// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sks_detector/DetectionArray.h>

namespace sks_detector {

/// The names of objects in topics: what may not stand in them is `_`, and names that would be equal are numbered.
std::vector<std::string> topicNames(const std::vector<std::string>& objects);

/// Poses of detections in standard messages: all of them on `~poses`, and the best instance of each object on
/// `~objects/<name>/pose`. Safe to use from several threads.
class PoseOutput {
public:
  /// @param listeners_changed called from the callback queue when somebody came to listen or left
  PoseOutput(const ros::NodeHandle& private_handle, std::function<void()> listeners_changed);

  /// The objects that may be detected: theirs are the topics. While the master is away nothing changes, so that it is
  /// to be tried again.
  void setObjects(const std::vector<std::string>& objects);

  bool listened() const;
  void publish(const DetectionArray& detections);

private:
  ros::NodeHandle handle_;
  std::function<void()> listeners_changed_;
  ros::Publisher all_;
  mutable std::mutex mutex_;                       // guards what follows
  std::map<std::string, ros::Publisher> best_of_;  // by object
};

}  // namespace sks_detector
