// SPDX-License-Identifier: BSD-3-Clause
#include "ros/configuration.hpp"

#include "core/settings/detector_table.hpp"

namespace sks_detector {

const sks::SettingsTable<NodeSettings>& nodeTable() {
  static const sks::SettingsTable<NodeSettings> table;
  return table;
}

std::vector<sks::BoundSettings> bound(Configuration& configuration) {
  return {nodeTable().bind(configuration.node), sks::detectorTable().bind(configuration.detector)};
}

const std::vector<sks::SettingInfo>& parameterInfos() {
  static const std::vector<sks::SettingInfo> infos = [] {
    std::vector<sks::SettingInfo> list = nodeTable().infos();
    list.insert(list.end(), sks::settingInfos().begin(), sks::settingInfos().end());
    return list;
  }();
  return infos;
}

std::string getParameter(const Configuration& configuration, const std::string& key) {
  const bool of_node = nodeTable().find(key) != nullptr;
  return of_node ? nodeTable().get(configuration.node, key) : sks::getSetting(configuration.detector, key);
}

bool isChangeable(const std::string& key) {
  return key != "codebook" && key != "codebook_directory" && key != "dataset_directory" && key != "service_timeout";
}

}  // namespace sks_detector
