// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters.hpp"

#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/detector_table.hpp"
#include "ros/detection_frame.hpp"
#include "ros/master_access.hpp"
#include "ros/parameter_tree.hpp"

namespace sks_detector {

ParameterReading readParameters(const ros::NodeHandle& private_handle) {
  return readParameters(readParameterTree(private_handle), private_handle.getNamespace());
}

ParameterReading readParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name_space) {
  ParameterReading reading;
  sks::Settings& detector = reading.configuration.detector;
  sks::SettingsOverlay overlay(bound(reading.configuration));
  TreeReading from_tree = overlayParameters(tree, name_space, overlay);
  reading.given = std::move(from_tree.given);
  reading.warnings = std::move(from_tree.warnings);
  NodeSettings& node = reading.configuration.node;
  try {
    checkFramePattern(node.tf_frame);
  } catch (const sks::Error& error) {
    reading.errors.push_back("parameters in " + name_space + "/: " + error.what() + "; the default is used");
    node.tf_frame = NodeSettings().tf_frame;
  }
  std::vector<std::string> of_detector;
  for (const TreeReading::Refused& refused : from_tree.refused) {
    const bool of_node = nodeTable().find(refused.key) != nullptr;
    if (of_node) {
      reading.errors.push_back(refused.message);
    } else {
      of_detector.push_back(refused.message);
    }
  }
  try {
    if (of_detector.empty()) sks::validate(detector);
  } catch (const sks::Error& error) {
    of_detector.push_back("parameters in " + name_space + "/: " + error.what());
  }
  if (of_detector.empty()) return reading;
  of_detector.back() += "; all settings of the detector stay at their defaults";
  reading.errors.insert(reading.errors.end(), of_detector.begin(), of_detector.end());
  detector = sks::Settings();
  return reading;
}

void ParameterMirror::write(const Configuration& configuration) {
  if (!masterAnswers()) return;  // what is not told now is told with the next change
  if (written_.empty()) deleteOldNames();
  for (const sks::SettingInfo& info : parameterInfos()) {
    const std::string text = getParameter(configuration, info.key);
    const auto [entry, is_new] = written_.emplace(info.key, text);
    if (!is_new && std::exchange(entry->second, text) == text) continue;
    writeParameter(private_handle_, info.key, info.type, text);
  }
}

void ParameterMirror::deleteOldNames() {
  for (const sks::OldSetting& old : sks::detectorTable().oldSettings()) {
    const std::string name = withSlashes(old.key);
    if (sks::detectorTable().find(old.key) == nullptr && private_handle_.hasParam(name)) {
      private_handle_.deleteParam(name);
    }
  }
}

}  // namespace sks_detector
