// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "ros/camera/camera_settings.hpp"

namespace sks_detector {

/// What the camera's private parameters say.
struct CameraParameters {
  CameraSettings settings;            ///< defaults where nothing, or nothing usable, was given
  std::vector<std::string> problems;  ///< wrong values, and unknown names with the nearest known one
};

CameraParameters readCameraParameters(const ros::NodeHandle& private_handle);

}  // namespace sks_detector
