// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/camera_parameters.hpp"

#include "ros/parameter_tree.hpp"

namespace sks_detector {

const sks::SettingsTable<CameraSettings>& cameraTable() {
  static const sks::SettingsTable<CameraSettings> table;
  return table;
}

CameraParameters readCameraParameters(const ros::NodeHandle& private_handle) {
  return readCameraParameters(readParameterTree(private_handle), private_handle.getNamespace());
}

CameraParameters readCameraParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name_space) {
  CameraParameters result;
  sks::SettingsOverlay overlay({cameraTable().bind(result.settings)});
  const TreeReading reading = overlayParameters(tree, name_space, overlay);
  result.problems = reading.warnings;
  for (const TreeReading::Refused& refused : reading.refused) {
    const std::string used = overlay.get(refused.key);
    const bool is_default = used == cameraTable().at(refused.key).default_value;
    result.problems.push_back(refused.message + "; " + (is_default ? "the default" : used) + " is used");
  }
  return result;
}

}  // namespace sks_detector
