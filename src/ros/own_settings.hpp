// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <sks_detector/settings.hpp>

#include "core/settings/value_text.hpp"
#include "core/settings/visit_settings.hpp"

namespace sks_detector {

// Settings by name and as text, of structs without groups whose visit() tells defaults, ranges, units and help, like
// sks::Settings, but which may also hold texts: NodeSettings, CameraSettings.

/// Null for an unknown key.
const sks::SettingInfo* findInfo(const std::vector<sks::SettingInfo>& infos, const std::string& key);

/// The known key that is nearest to a misspelt one; a right name in a wrong group is one mistake.
std::string nearestKey(const std::vector<sks::SettingInfo>& infos, const std::string& key);

/// Throws sks::Error(bad_usage) for a text that is no value of the setting's type.
[[noreturn]] void refuseText(const sks::SettingInfo& info, const std::string& text);
/// @throws sks::Error(bad_usage) for a number out of the setting's range
void checkRange(const sks::SettingInfo& info, double value);

inline std::string textOf(const std::string& value) {
  return value;
}
template <typename T>
std::string textOf(const T& value) {
  return sks::toText(value);
}

template <typename T>
const char* typeName() {
  if (std::is_same_v<T, std::string>) return "string";
  if (std::is_same_v<T, double>) return "double";
  return std::is_same_v<T, int> ? "int" : "bool";
}

/// Calls `f(key, value, about)` for each setting.
template <typename Settings, typename Function>
void forEachOwnSetting(Settings& settings, Function function) {
  std::remove_const_t<Settings>::visit(settings, sks::Flatten<Function>(function));
}

/// All settings; their type may be "string".
template <typename Settings>
const std::vector<sks::SettingInfo>& ownSettingInfos() {
  static const std::vector<sks::SettingInfo> infos = [] {
    const Settings defaults;
    std::vector<sks::SettingInfo> list;
    forEachOwnSetting(defaults, [&](const std::string& key, const auto& value, const sks::About& about) {
      const char* type = typeName<std::decay_t<decltype(value)>>();
      list.push_back({key, type, textOf(value), about.range, about.unit, about.help, {}, about.binding});
    });
    return list;
  }();
  return infos;
}

/// Empty for an unknown key.
template <typename Settings>
std::string getOwnSetting(const Settings& settings, const std::string& wanted) {
  std::string text;
  forEachOwnSetting(settings, [&](const std::string& key, const auto& value, const sks::About&) {
    if (key == wanted) text = textOf(value);
  });
  return text;
}

/// Does nothing for an unknown key. @throws sks::Error(bad_usage) naming type, range and unit; the old value then stays
template <typename Settings>
void setOwnSetting(Settings& settings, const sks::SettingInfo& info, const std::string& text) {
  forEachOwnSetting(settings, [&](const std::string& key, auto& value, const sks::About&) {
    if (key != info.key) return;
    using T = std::decay_t<decltype(value)>;
    T wanted{};
    if constexpr (std::is_same_v<T, std::string>) {
      wanted = text;
    } else if (!sks::fromText(text, wanted)) {
      refuseText(info, text);
    }
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) checkRange(info, wanted);
    value = wanted;
  });
}

}  // namespace sks_detector
