// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/settings.hpp>

#include <utility>

#include <sks_detector/error.hpp>
#include <sks_detector/thresholds.hpp>

#include "core/settings/detector_table.hpp"

namespace sks {
namespace {

double numberOf(const Settings& settings, const std::string& key) {
  double number = 0;
  fromText(getSetting(settings, key), number);
  return number;
}

/// Settings of which the first must be less than the second.
const std::pair<const char*, const char*> ordered[] = {
    {"sanitize.min_range", "sanitize.max_range"},    {"sanitize.crop_min_x", "sanitize.crop_max_x"},
    {"sanitize.crop_min_y", "sanitize.crop_max_y"},  {"sanitize.crop_min_z", "sanitize.crop_max_z"},
    {"surface.resolution", "surface.normal_radius"}, {"surface.resolution", "keypoints.grid_size"},
    {"surface.normal_radius", "descriptor.radius"},
};

}  // namespace

const SettingsTable<Settings>& detectorTable() {
  static const SettingsTable<Settings> table({
      {"verification.candidates", "detection.hypotheses", "0", "hough"},
      {"verification.ambiguity", "matching.ambiguity", "", ""},
      {"verification.skip_planes", "keypoints.skip_planes", "", ""},
  });
  return table;
}

const std::vector<SettingInfo>& settingInfos() {
  return detectorTable().infos();
}

std::string getSetting(const Settings& settings, const std::string& key) {
  return detectorTable().get(settings, key);
}

void setSetting(Settings& settings, const std::string& key, const std::string& value,
                std::vector<std::string>* warnings) {
  const std::string warning = detectorTable().set(settings, key, value);
  if (warnings != nullptr && !warning.empty()) warnings->push_back(warning);
}

void validate(const Settings& settings) {
  detectorTable().checkRanges(settings);
  for (const auto& [less, greater] : ordered) {
    if (numberOf(settings, less) < numberOf(settings, greater)) continue;
    throw Error(ErrorCode::bad_usage, std::string(less) + " = " + getSetting(settings, less) + " must be less than " +
                                          greater + " = " + getSetting(settings, greater));
  }
  Thresholds(settings.detection).ofSingleObjects();  // throws where it cannot be understood
}

std::vector<std::string> bindingConflicts(const Settings& codebook, const Settings& wanted) {
  Settings asked = wanted;
  if (asked.descriptor.type == DescriptorType::automatic) asked.descriptor.type = codebook.descriptor.type;
  std::vector<std::string> conflicts;
  for (const SettingInfo& info : settingInfos()) {
    if (info.binding != Binding::codebook) continue;
    if (getSetting(codebook, info.key) != getSetting(asked, info.key)) conflicts.push_back(info.key);
  }
  return conflicts;
}

std::string nearestSettingKey(const std::string& key) {
  return nearestKey(settingInfos(), key);
}

}  // namespace sks
