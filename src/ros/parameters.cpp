// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters.hpp"

#include <utility>

#include <ros/master.h>

#include <sks_detector/error.hpp>

#include "ros/parameter_tree.hpp"

namespace sks_detector {

ParameterReading readParameters(const ros::NodeHandle& private_handle) {
  ParameterReading reading;
  Configuration configuration;
  bool detector_usable = true;
  const auto is_parameter = [](const std::string& key) { return findParameter(key) != nullptr; };
  for (const auto& [key, text] : readParameterTree(private_handle, is_parameter)) {
    if (!is_parameter(key)) {
      reading.warnings.push_back(unknownParameter(private_handle, key, nearestParameter(key)));
      continue;
    }
    try {
      setParameter(configuration, key, text);
      reading.given.push_back(key);
    } catch (const sks::Error& error) {
      reading.errors.push_back("parameter " + parameterName(private_handle, key) + ": " + error.what());
      detector_usable = detector_usable && isNodeSetting(key);
    }
  }
  try {
    if (detector_usable) sks::validate(configuration.detector);
  } catch (const sks::Error& error) {
    reading.errors.push_back("parameters in " + private_handle.getNamespace() + "/: " + error.what());
    detector_usable = false;
  }
  if (!detector_usable) {
    reading.errors.back() += "; all settings of the detector stay at their defaults";
    configuration.detector = sks::Settings();
  }
  reading.configuration = std::move(configuration);
  return reading;
}

void ParameterMirror::write(const Configuration& configuration) {
  // roscpp would wait for a master that is gone, for ever; what is not told now is told with the next change
  if (!ros::master::check()) return;
  for (const sks::SettingInfo& info : parameterInfos()) {
    const std::string text = getParameter(configuration, info.key);
    const auto [entry, is_new] = written_.emplace(info.key, text);
    if (!is_new && std::exchange(entry->second, text) == text) continue;
    writeParameter(private_handle_, info.key, info.type, text);
  }
}

}  // namespace sks_detector
