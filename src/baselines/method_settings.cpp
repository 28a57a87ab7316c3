// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/method_settings.hpp"

#include <algorithm>
#include <type_traits>

#include <sks_detector/error.hpp>

#include "core/settings/nearest_name.hpp"
#include "core/settings/value_text.hpp"
#include "core/settings/visit_settings.hpp"

namespace sks::baselines {
namespace {

template <typename SettingsType, typename Function>
void forEach(SettingsType& settings, Function function) {
  MethodSettings::visit(settings, Flatten<Function>(function));
}

template <typename T>
const char* typeName() {
  if (std::is_same_v<T, double>) return "double";
  return std::is_same_v<T, int> ? "int" : "bool";
}

const SettingInfo& infoOf(const std::string& key) {
  const auto& infos = methodSettingInfos();
  const auto found = std::find_if(infos.begin(), infos.end(), [&](const SettingInfo& info) { return info.key == key; });
  if (found != infos.end()) return *found;
  std::vector<std::string> keys;
  keys.reserve(infos.size());
  for (const SettingInfo& info : infos) keys.push_back(info.key);
  throw Error(ErrorCode::bad_usage, "unknown setting '" + key + "': did you mean '" + nearestName(key, keys) + "'?");
}

[[noreturn]] void refuse(const SettingInfo& info, const std::string& text) {
  const std::string kind = info.type == "bool" ? "" : info.type == "int" ? "a whole number in " : "a number in ";
  throw Error(ErrorCode::bad_usage, info.key + " = " + text + ": expected " + kind + allowedValues(info) +
                                        (info.unit.empty() ? "" : " [" + info.unit + "]"));
}

template <typename T>
bool inRange(const T& value, const Range& range) {
  if constexpr (std::is_same_v<T, bool>) return true;
  return value >= range.min && value <= range.max;
}

}  // namespace

const std::vector<SettingInfo>& methodSettingInfos() {
  static const std::vector<SettingInfo> infos = [] {
    std::vector<SettingInfo> list;
    const MethodSettings defaults;
    forEach(defaults, [&](const std::string& key, const auto& value, const About& about) {
      using T = std::decay_t<decltype(value)>;
      list.push_back({key, typeName<T>(), toText(value), about.range, about.unit, about.help, {}, about.binding});
    });
    return list;
  }();
  return infos;
}

bool isMethodSetting(const std::string& key) {
  const std::string group = key.substr(0, key.find('.')) + ".";
  const auto& infos = methodSettingInfos();
  return std::any_of(infos.begin(), infos.end(),
                     [&](const SettingInfo& info) { return info.key.rfind(group, 0) == 0; });
}

std::string getMethodSetting(const MethodSettings& settings, const std::string& wanted) {
  infoOf(wanted);
  std::string text;
  forEach(settings, [&](const std::string& key, const auto& value, const About&) {
    if (key == wanted) text = toText(value);
  });
  return text;
}

void setMethodSetting(MethodSettings& settings, const std::string& wanted, const std::string& text) {
  const SettingInfo& info = infoOf(wanted);
  forEach(settings, [&](const std::string& key, auto& value, const About&) {
    if (key != wanted) return;
    std::decay_t<decltype(value)> parsed{};
    if (!fromText(text, parsed) || !inRange(parsed, info.range)) refuse(info, text);
    value = parsed;
  });
}

}  // namespace sks::baselines
