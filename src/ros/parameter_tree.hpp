// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

#include <ros/node_handle.h>

namespace sks_detector {

/// The private parameters as text, by dotted key: `~keypoints/discard` is "keypoints.discard". Maps are groups, but not
/// where a parameter has that name.
std::map<std::string, std::string> readParameterTree(const ros::NodeHandle& private_handle,
                                                     const std::function<bool(const std::string& key)>& is_parameter);

/// The name on the parameter server, for messages.
std::string parameterName(const ros::NodeHandle& private_handle, const std::string& key);

/// A warning that names the nearest known key.
std::string unknownParameter(const ros::NodeHandle& private_handle, const std::string& key, const std::string& nearest);

/// Sets a parameter, of a type like "double" or "string" (that of sks::SettingInfo), from text that has been checked.
void writeParameter(const ros::NodeHandle& private_handle, const std::string& key, const std::string& type,
                    const std::string& text);

}  // namespace sks_detector
