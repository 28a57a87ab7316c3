// SPDX-License-Identifier: BSD-3-Clause
#include "ros/configuration.hpp"

#include <sks_detector/error.hpp>

#include "ros/own_settings.hpp"

namespace sks_detector {

const std::vector<sks::SettingInfo>& parameterInfos() {
  static const std::vector<sks::SettingInfo> infos = [] {
    std::vector<sks::SettingInfo> list = ownSettingInfos<NodeSettings>();
    list.insert(list.end(), sks::settingInfos().begin(), sks::settingInfos().end());
    return list;
  }();
  return infos;
}

const sks::SettingInfo* findParameter(const std::string& key) {
  return findInfo(parameterInfos(), key);
}

bool isNodeSetting(const std::string& key) {
  return findInfo(ownSettingInfos<NodeSettings>(), key) != nullptr;
}

std::string getParameter(const Configuration& configuration, const std::string& key) {
  return isNodeSetting(key) ? getOwnSetting(configuration.node, key) : sks::getSetting(configuration.detector, key);
}

void setParameter(Configuration& configuration, const std::string& key, const std::string& text) {
  const sks::SettingInfo* info = findParameter(key);
  if (!info) {
    throw sks::Error(sks::ErrorCode::bad_usage,
                     "unknown parameter '" + key + "': did you mean '" + nearestParameter(key) + "'?");
  }
  if (isNodeSetting(key)) {
    setOwnSetting(configuration.node, *info, text);
  } else {
    sks::setSetting(configuration.detector, key, text);
  }
}

std::string nearestParameter(const std::string& key) {
  return nearestKey(parameterInfos(), key);
}

bool isChangeable(const std::string& key) {
  return key != "codebook" && key != "codebook_directory" && key != "dataset_directory" && key != "service_timeout";
}

}  // namespace sks_detector
