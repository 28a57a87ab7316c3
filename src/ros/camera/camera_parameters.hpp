// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include "core/settings/settings_table.hpp"
#include "ros/camera/camera_settings.hpp"

namespace sks_detector {

const sks::SettingsTable<CameraSettings>& cameraTable();

/// What the camera's private parameters say.
struct CameraParameters {
  CameraSettings settings;            ///< defaults where nothing, or nothing usable, was given
  std::vector<std::string> problems;  ///< wrong values, and unknown names with the nearest known one
};

CameraParameters readCameraParameters(const ros::NodeHandle& private_handle);
/// The same from a tree of maps. @param name_space of the tree, for messages
CameraParameters readCameraParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name_space);

}  // namespace sks_detector
