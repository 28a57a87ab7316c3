// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_parameters.hpp"

#include <sks_detector/error.hpp>

#include "ros/own_settings.hpp"
#include "ros/parameter_tree.hpp"

namespace sks_detector {

CameraParameters readCameraParameters(const ros::NodeHandle& private_handle) {
  CameraParameters result;
  const auto& infos = ownSettingInfos<CameraSettings>();
  const auto is_parameter = [&](const std::string& key) { return findInfo(infos, key) != nullptr; };
  for (const auto& [key, text] : readParameterTree(private_handle, is_parameter)) {
    const sks::SettingInfo* info = findInfo(infos, key);
    if (!info) {
      result.problems.push_back(unknownParameter(private_handle, key, nearestKey(infos, key)));
      continue;
    }
    try {
      setOwnSetting(result.settings, *info, text);
    } catch (const sks::Error& error) {
      result.problems.push_back("parameter " + parameterName(private_handle, key) + ": " + error.what() +
                                "; the default is used");
    }
  }
  return result;
}

}  // namespace sks_detector
