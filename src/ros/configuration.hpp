// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/settings.hpp>

#include "core/settings/settings_overlay.hpp"
#include "ros/node_settings.hpp"

namespace sks_detector {

/// Everything that private parameters set.
struct Configuration {
  sks::Settings detector;
  NodeSettings node;
};

const sks::SettingsTable<NodeSettings>& nodeTable();

/// Both parts with their tables, for a sks::SettingsOverlay.
std::vector<sks::BoundSettings> bound(Configuration& configuration);

/// All parameters, first the node's; their type may also be "string". On the parameter server the dots of the keys are
/// slashes.
const std::vector<sks::SettingInfo>& parameterInfos();

/// The value of a parameter as text that can be set again unchanged. @throws sks::Error(bad_usage) for an unknown key
std::string getParameter(const Configuration& configuration, const std::string& key);

/// Whether a parameter can be changed while the node runs.
bool isChangeable(const std::string& key);

}  // namespace sks_detector
