// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/settings.hpp>

#include "ros/node_settings.hpp"

namespace sks_detector {

/// Everything that private parameters set.
struct Configuration {
  sks::Settings detector;
  NodeSettings node;
};

/// All parameters; their type may also be "string". On the parameter server the dots of the keys are slashes.
const std::vector<sks::SettingInfo>& parameterInfos();
/// Null for an unknown key.
const sks::SettingInfo* findParameter(const std::string& key);
/// Whether a parameter is one of NodeSettings, and not one of the detector's.
bool isNodeSetting(const std::string& key);

/// The value of a parameter as text that setParameter() takes back unchanged.
/// @throws sks::Error(bad_usage) for an unknown key
std::string getParameter(const Configuration& configuration, const std::string& key);
/// Sets a parameter from text. @throws sks::Error(bad_usage) naming the nearest known key, or type, range and unit
void setParameter(Configuration& configuration, const std::string& key, const std::string& text);

/// The known key that is nearest to a misspelt one; a right name in a wrong group is one mistake.
std::string nearestParameter(const std::string& key);

/// Whether a parameter can be changed while the node runs.
bool isChangeable(const std::string& key);

}  // namespace sks_detector
