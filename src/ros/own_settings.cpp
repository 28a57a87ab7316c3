// SPDX-License-Identifier: BSD-3-Clause
#include "ros/own_settings.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/edit_distance.hpp"

namespace sks_detector {
namespace {

std::string lastPart(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

std::string rangeOf(const sks::SettingInfo& info) {
  return sks::allowedValues(info) + (info.unit.empty() ? "" : " [" + info.unit + "]");
}

}  // namespace

const sks::SettingInfo* findInfo(const std::vector<sks::SettingInfo>& infos, const std::string& key) {
  const auto found =
      std::find_if(infos.begin(), infos.end(), [&](const sks::SettingInfo& info) { return info.key == key; });
  return found == infos.end() ? nullptr : &*found;
}

std::string nearestKey(const std::vector<sks::SettingInfo>& infos, const std::string& key) {
  const auto distance = [&](const sks::SettingInfo& info) {
    return std::min(sks::editDistance(key, info.key), sks::editDistance(lastPart(key), lastPart(info.key)) + 1);
  };
  const auto nearer = [&](const sks::SettingInfo& a, const sks::SettingInfo& b) { return distance(a) < distance(b); };
  return std::min_element(infos.begin(), infos.end(), nearer)->key;
}

void refuseText(const sks::SettingInfo& info, const std::string& text) {
  std::string expected = "true or false";
  if (info.type == "int") expected = "a whole number in " + rangeOf(info);
  if (info.type == "double") expected = "a number in " + rangeOf(info);
  throw sks::Error(sks::ErrorCode::bad_usage, info.key + " = " + text + ": expected " + expected);
}

void checkRange(const sks::SettingInfo& info, double value) {
  if (value >= info.range.min && value <= info.range.max) return;
  throw sks::Error(sks::ErrorCode::bad_usage,
                   info.key + " = " + sks::toText(value) + " is out of range: " + rangeOf(info));
}

}  // namespace sks_detector
