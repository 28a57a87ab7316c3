// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>

#include "ros/camera/camera.hpp"
#include "ros/camera/camera_settings.hpp"

namespace sks_detector {

/// The camera as a ROS node, for the nodelet and the executable alike (docs/camera.md).
class CameraNode {
public:
  /// @param private_handle where its parameters and topics are
  /// @param name of the node, for diagnostics
  CameraNode(const ros::NodeHandle& private_handle, const std::string& name);
  ~CameraNode();
  CameraNode(const CameraNode&) = delete;
  CameraNode& operator=(const CameraNode&) = delete;

private:
  template <typename Message>
  ros::Publisher advertise(const std::string& topic);
  /// Runs the camera only while somebody listens.
  void updateWanted();
  void publish(const CameraFrame& frame);
  ros::Time nextStamp();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle private_handle_;
  CameraSettings settings_;
  std::mutex mutex_;  // guards the publishers while they are made, and that there is a camera
  ros::Publisher points_, info_, depth_, color_;
  ros::Time last_stamp_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  std::uint64_t frames_before_ = 0;
  ros::SteadyTime diagnosed_;
  bool streaming_ = false;  // when it was diagnosed last: what began since has no rate yet
  std::unique_ptr<Camera> camera_;
  ros::SteadyTimer timer_;
};

}  // namespace sks_detector
