// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <XmlRpcValue.h>
#include <ros/node_handle.h>

#include "core/settings/settings_overlay.hpp"

namespace sks_detector {

/// What came of private parameters.
struct TreeReading {
  struct Refused {
    std::string key;  ///< its present name
    std::string message;
  };

  std::vector<std::string> given;     ///< keys that were set, by their present names
  std::vector<Refused> refused;       ///< values that cannot be used, and why
  std::vector<std::string> warnings;  ///< unknown names with the nearest known one, and old names
};

/// The private parameters as one tree of maps.
XmlRpc::XmlRpcValue readParameterTree(const ros::NodeHandle& private_handle);

/// Sets what a tree says: `~keypoints/discard` is "keypoints.discard". An old name beside the present one is only
/// warned about where both say the same, as they do after ParameterMirror wrote what is in force.
/// @param name_space of the tree, for messages
TreeReading overlayParameters(XmlRpc::XmlRpcValue tree, const std::string& name_space, sks::SettingsOverlay& overlay);

/// The name on the parameter server, relative to its namespace.
std::string withSlashes(std::string key);

/// Sets a parameter, of a type like "double" or "string" (that of sks::SettingInfo), from text that has been checked.
void writeParameter(const ros::NodeHandle& private_handle, const std::string& key, const std::string& type,
                    const std::string& text);

}  // namespace sks_detector
