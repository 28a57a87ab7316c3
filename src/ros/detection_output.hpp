// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/timer.h>
#include <sks_detector/DetectionArray.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/frame_detector.hpp"
#include "ros/markers.hpp"
#include "ros/node_settings.hpp"
#include "ros/pose_output.hpp"
#include "ros/result_output.hpp"

namespace sks_detector {

/// What the node publishes of each frame: `~detections`, `~poses`, `~objects/<name>/pose`, `~markers`,
/// `~image_overlay`, `~keypoints`, `~votes`, `~support` and
/// /tf, and what resultOutputs() has. Safe to use from several threads.
class DetectionOutput {
public:
  /// @param listeners_changed called from the callback queue when somebody came to listen or left
  DetectionOutput(ros::NodeHandle& private_handle, std::function<void()> listeners_changed);
  /// Clears the markers, unless ROS has been shut down before: then rviz lets them go a few seconds later.
  ~DetectionOutput();
  DetectionOutput(const DetectionOutput&) = delete;
  DetectionOutput& operator=(const DetectionOutput&) = delete;

  /// Whether somebody listens to anything.
  bool listened() const;
  /// What is listened to of the topics that cost time.
  FrameExtras wantedExtras() const;

  /// PoseOutput::setObjects()
  void setObjects(const std::vector<std::string>& objects) { poses_.setObjects(objects); }

  /// Advertises /tf or no longer does; while the master is away nothing changes, so that it is to be tried again.
  void advertiseTransforms(bool wanted);
  /// With ~publish_tf also each detection's pose on /tf, by the names of detectionFrame().
  void publish(const FrameResult& result, const NodeSettings& settings);
  /// Takes the markers out of rviz.
  void clearMarkers();

private:
  void publishMarkers();
  void broadcastPoses(const DetectionArray& detections, const NodeSettings& settings);
  void keepMarkers();

  ros::Publisher detections_;
  ros::Publisher markers_;
  ros::Publisher keypoints_;
  ros::Publisher votes_;
  ros::Publisher picture_;
  ros::Publisher support_;
  PoseOutput poses_;
  std::vector<std::unique_ptr<ResultOutput>> further_;
  ros::Timer keep_markers_;

  ros::NodeHandle handle_;
  std::mutex transforms_mutex_;
  ros::Publisher transforms_;  // to /tf

  std::mutex shown_mutex_;
  DetectionArray shown_;  // by the markers
  MarkerStyle shown_style_;
};

}  // namespace sks_detector
