// SPDX-License-Identifier: BSD-3-Clause
// Settings by name and as text, of any struct whose visit() functions tell defaults, ranges, units and help: those of
// the detector, of the baselines, of the node and of the camera. Command line, YAML files, the parameter server and
// dynamic_reconfigure all read and write them through this table.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <sks_detector/settings.hpp>

#include "core/settings/value_text.hpp"
#include "core/settings/visit_settings.hpp"

namespace sks {

/// An old name of a setting, or of one of its values, that is still understood.
struct OldSetting {
  std::string key;        ///< e.g. "verification.ambiguity"
  std::string new_key;    ///< e.g. "matching.ambiguity"
  std::string value;      ///< where only one value of `key` has moved: that value; empty: all of them
  std::string new_value;  ///< what that value is called now
};

/// A key and its value as text.
struct Assignment {
  std::string key, text;
  std::string old_name;  ///< what stood there, where that was an old name, e.g. "verification.candidates = 0"
};

/// The part of a table that is the same for all types: keys and what is said about them.
class SettingKeys {
public:
  SettingKeys(std::vector<SettingInfo> infos, std::vector<OldSetting> old_settings)
      : infos_(std::move(infos)), old_settings_(std::move(old_settings)) {}

  const std::vector<SettingInfo>& infos() const { return infos_; }
  const std::vector<OldSetting>& oldSettings() const { return old_settings_; }

  /// Null for an unknown key and for an old one.
  const SettingInfo* find(const std::string& key) const;
  /// Also by an old name. @throws Error(bad_usage) naming the nearest known key
  const SettingInfo& at(const std::string& key) const;
  /// Whether a key, or an old one, begins with this name and a dot.
  bool isGroup(const std::string& name) const;
  /// Replaces an old name by the one that is used now.
  Assignment resolve(const std::string& key, const std::string& text) const;

private:
  std::vector<SettingInfo> infos_;
  std::vector<OldSetting> old_settings_;
};

/// The known key that is nearest to a misspelt one, by edit distance; a right name in a wrong or no group is one
/// mistake. Empty where none is near.
std::string nearestKey(const std::vector<SettingInfo>& infos, const std::string& key);

/// "unknown setting 'x': did you mean 'y'?", or which ones there are.
[[noreturn]] void refuseKey(const std::vector<SettingInfo>& infos, const std::string& key);
/// Throws Error(bad_usage) for a text that is no value of the setting's type.
[[noreturn]] void refuseText(const SettingInfo& info, const std::string& text);
/// @throws Error(bad_usage) for a number out of range, NaN too
void checkRange(const SettingInfo& info, double value);
/// The warning about an old name; empty where none was used.
std::string movedText(const Assignment& assignment);

/// Settings of any type, with their table.
struct BoundSettings {
  const SettingKeys* keys;
  std::function<std::string(const std::string& key)> get;
  std::function<void(const std::string& key, const std::string& text)> set;
};

/// What SettingInfo::type says.
template <typename V>
const char* settingTypeName() {
  if (std::is_enum_v<V>) return "choice";
  if (std::is_same_v<V, std::string>) return "string";
  if (std::is_same_v<V, double>) return "double";
  return std::is_same_v<V, int> ? "int" : "bool";
}

template <typename T>
class SettingsTable : public SettingKeys {
public:
  explicit SettingsTable(const std::vector<OldSetting>& old_settings = {}) : SettingKeys(describe(), old_settings) {}

  /// The value as text that set() takes back unchanged. @throws Error(bad_usage) for an unknown key
  std::string get(const T& settings, const std::string& key) const {
    const SettingInfo& info = at(key);
    std::string text;
    forEachSetting(settings, [&](const std::string& each, const auto& value, const About&) {
      if (each == info.key) text = toText(value);
    });
    return text;
  }

  /// Sets from text, and returns what there is to warn about: an old name; else nothing.
  /// @throws Error(bad_usage) naming the nearest known key, or type, range and unit; the old value then stays
  std::string set(T& settings, const std::string& key, const std::string& text) const {
    const Assignment wanted = resolve(key, text);
    const SettingInfo& info = at(wanted.key);
    forEachSetting(settings, [&](const std::string& each, auto& value, const About&) {
      if (each != info.key) return;
      std::decay_t<decltype(value)> parsed{};
      if (!fromText(wanted.text, parsed)) refuseText(info, wanted.text);
      check(info, parsed);
      value = parsed;
    });
    return movedText(wanted);
  }

  /// @throws Error(bad_usage) naming key, value, range and unit
  void checkRanges(const T& settings) const {
    forEachSetting(settings, [&](const std::string& key, const auto& value, const About&) { check(at(key), value); });
  }

  /// The bound settings and this table must live longer.
  BoundSettings bind(T& settings) const {
    return {this, [this, &settings](const std::string& key) { return get(settings, key); },
            [this, &settings](const std::string& key, const std::string& text) { set(settings, key, text); }};
  }

private:
  template <typename V>
  static constexpr bool is_number = std::is_same_v<V, double> || std::is_same_v<V, int>;

  template <typename V>
  static void check(const SettingInfo& info, const V& value) {
    if constexpr (is_number<V>) checkRange(info, value);
  }

  static std::vector<SettingInfo> describe() {
    const T defaults;
    std::vector<SettingInfo> list;
    forEachSetting(defaults, [&](const std::string& key, const auto& value, const About& about) {
      using V = std::decay_t<decltype(value)>;
      std::vector<std::string> choices;
      if constexpr (std::is_enum_v<V>) choices.assign(EnumNames<V>::value.begin(), EnumNames<V>::value.end());
      list.push_back(
          {key, settingTypeName<V>(), toText(value), about.range, about.unit, about.help, choices, about.binding});
    });
    return list;
  }
};

}  // namespace sks
