// SPDX-License-Identifier: BSD-3-Clause
// Values as text, whatever the global locale.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>

#include <sks_detector/settings.hpp>

namespace sks {

/// The shortest text that reads back as the same number.
std::string toText(double value);
std::string toText(int value);
std::string toText(bool value);
std::string toText(const std::string& value);

template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
std::string toText(Enum value) {
  return EnumNames<Enum>::value.at(std::size_t(value));
}

/// False, and `value` is of no use, where the whole text is not one value of its type.
bool fromText(const std::string& text, double& value);
bool fromText(const std::string& text, int& value);
bool fromText(const std::string& text, bool& value);
bool fromText(const std::string& text, std::string& value);

template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
bool fromText(const std::string& text, Enum& value) {
  const auto& names = EnumNames<Enum>::value;
  const auto found = std::find(names.begin(), names.end(), text);
  value = Enum(found - names.begin());
  return found != names.end();
}

/// What a setting may be: "0.001 to 0.5 [m]", "auto, shot, cshot", "true, false" or "any text".
std::string allowedValues(const SettingInfo& info);

}  // namespace sks
