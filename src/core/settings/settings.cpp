// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/settings.hpp>

#include <algorithm>
#include <thread>
#include <type_traits>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/settings/edit_distance.hpp"
#include "core/settings/value_text.hpp"
#include "core/settings/visit_settings.hpp"

namespace sks {
namespace {

template <typename T>
const char* typeName() {
  if (std::is_same_v<T, double>) return "double";
  if (std::is_same_v<T, int>) return "int";
  return std::is_same_v<T, bool> ? "bool" : "choice";
}

template <typename T>
std::vector<std::string> choicesOf() {
  if constexpr (std::is_enum_v<T>) return {EnumNames<T>::value.begin(), EnumNames<T>::value.end()};
  return {};
}

const SettingInfo& infoOf(const std::string& key) {
  const auto& infos = settingInfos();
  const auto found = std::find_if(infos.begin(), infos.end(), [&](const SettingInfo& info) { return info.key == key; });
  if (found != infos.end()) return *found;
  throw Error(ErrorCode::bad_usage, "unknown setting '" + key + "': did you mean '" + nearestSettingKey(key) + "'?");
}

std::string withUnit(const SettingInfo& info) {
  return allowedValues(info) + (info.unit.empty() ? "" : " [" + info.unit + "]");
}

/// What a text must be to be a value of the setting.
std::string expectation(const SettingInfo& info) {
  if (info.type == "bool") return "true or false";
  if (info.type == "choice") return "one of " + allowedValues(info);
  return (info.type == "int" ? "a whole number in " : "a number in ") + withUnit(info);
}

template <typename T>
void checkRange(const std::string& key, const T& value) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
    const SettingInfo& info = infoOf(key);
    if (!(value >= info.range.min && value <= info.range.max)) {  // so that NaN fails too
      throw Error(ErrorCode::bad_usage, key + " = " + toText(value) + " is out of range: " + withUnit(info));
    }
  }
}

std::string lastPart(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

double numberOf(const Settings& settings, const std::string& wanted) {
  double number = 0;
  forEachSetting(settings, [&](const std::string& key, const auto& value, const About&) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      if (key == wanted) number = value;
    }
  });
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

const std::vector<SettingInfo>& settingInfos() {
  static const std::vector<SettingInfo> infos = [] {
    std::vector<SettingInfo> list;
    const Settings defaults;
    forEachSetting(defaults, [&](const std::string& key, const auto& value, const About& about) {
      using T = std::decay_t<decltype(value)>;
      list.push_back(
          {key, typeName<T>(), toText(value), about.range, about.unit, about.help, choicesOf<T>(), about.binding});
    });
    return list;
  }();
  return infos;
}

std::string getSetting(const Settings& settings, const std::string& wanted) {
  infoOf(wanted);
  std::string text;
  forEachSetting(settings, [&](const std::string& key, const auto& value, const About&) {
    if (key == wanted) text = toText(value);
  });
  return text;
}

void setSetting(Settings& settings, const std::string& wanted, const std::string& text) {
  const SettingInfo& info = infoOf(wanted);
  forEachSetting(settings, [&](const std::string& key, auto& value, const About&) {
    if (key != wanted) return;
    std::decay_t<decltype(value)> parsed{};
    if (!fromText(text, parsed)) {
      throw Error(ErrorCode::bad_usage, key + " = " + text + ": expected " + expectation(info));
    }
    checkRange(key, parsed);
    value = parsed;
  });
}

void validate(const Settings& settings) {
  forEachSetting(settings, [](const std::string& key, const auto& value, const About&) { checkRange(key, value); });
  for (const auto& [less, greater] : ordered) {
    if (numberOf(settings, less) < numberOf(settings, greater)) continue;
    throw Error(ErrorCode::bad_usage, std::string(less) + " = " + getSetting(settings, less) + " must be less than " +
                                          greater + " = " + getSetting(settings, greater));
  }
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
  const auto distance = [&](const SettingInfo& info) {  // a right name in the wrong or no group is one mistake
    return std::min(editDistance(key, info.key), editDistance(lastPart(key), lastPart(info.key)) + 1);
  };
  const auto& infos = settingInfos();
  return std::min_element(infos.begin(), infos.end(),
                          [&](const SettingInfo& a, const SettingInfo& b) { return distance(a) < distance(b); })
      ->key;
}

int threadCount(const Settings& settings) {
  return settings.threads > 0 ? settings.threads : std::max(1, int(std::thread::hardware_concurrency()));
}

}  // namespace sks
