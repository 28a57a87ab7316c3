// SPDX-License-Identifier: BSD-3-Clause
#include "ros/configuration.hpp"

#include <algorithm>
#include <type_traits>

#include <sks_detector/error.hpp>

#include "core/edit_distance.hpp"
#include "core/value_text.hpp"
#include "core/visit_settings.hpp"

namespace sks_detector {
namespace {

template <typename T>
constexpr bool is_text = std::is_same_v<std::decay_t<T>, std::string>;

template <typename T>
std::string textOf(const T& value) {
  if constexpr (is_text<T>) {
    return value;
  } else {
    return sks::toText(value);
  }
}

template <typename T>
const char* typeName(const T&) {
  if (std::is_same_v<T, double>) return "double";
  return std::is_same_v<T, bool> ? "bool" : "string";
}

/// Calls `f(key, value, about)` for each setting of the node.
template <typename Settings, typename Function>
void forEachNodeSetting(Settings& settings, Function function) {
  NodeSettings::visit(settings, sks::Flatten<Function>(function));
}

bool isNodeSetting(const std::string& wanted) {
  const NodeSettings defaults;
  bool found = false;
  forEachNodeSetting(defaults,
                     [&](const std::string& key, const auto&, const sks::About&) { found = found || key == wanted; });
  return found;
}

template <typename T>
void assign(T& value, const sks::SettingInfo& info, const std::string& text) {
  if constexpr (is_text<T>) {
    value = text;
  } else {
    T parsed{};
    if (!sks::fromText(text, parsed)) {
      throw sks::Error(sks::ErrorCode::bad_usage,
                       info.key + " = " + text + ": expected " + (info.type == "bool" ? "true or false" : "a number"));
    }
    if (info.type == "double" && !(double(parsed) >= info.range.min && double(parsed) <= info.range.max)) {
      throw sks::Error(sks::ErrorCode::bad_usage, info.key + " = " + text + " is out of range: " +
                                                      sks::allowedValues(info) + " [" + info.unit + "]");
    }
    value = parsed;
  }
}

std::string lastPart(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

}  // namespace

const std::vector<sks::SettingInfo>& parameterInfos() {
  static const std::vector<sks::SettingInfo> infos = [] {
    const NodeSettings defaults;
    std::vector<sks::SettingInfo> list;
    forEachNodeSetting(defaults, [&](const std::string& key, const auto& value, const sks::About& about) {
      list.push_back({key, typeName(value), textOf(value), about.range, about.unit, about.help, {}, about.binding});
    });
    list.insert(list.end(), sks::settingInfos().begin(), sks::settingInfos().end());
    return list;
  }();
  return infos;
}

const sks::SettingInfo* findParameter(const std::string& key) {
  const auto& infos = parameterInfos();
  const auto found =
      std::find_if(infos.begin(), infos.end(), [&](const sks::SettingInfo& info) { return info.key == key; });
  return found == infos.end() ? nullptr : &*found;
}

std::string getParameter(const Configuration& configuration, const std::string& wanted) {
  if (!isNodeSetting(wanted)) return sks::getSetting(configuration.detector, wanted);
  std::string text;
  forEachNodeSetting(configuration.node, [&](const std::string& key, const auto& value, const sks::About&) {
    if (key == wanted) text = textOf(value);
  });
  return text;
}

void setParameter(Configuration& configuration, const std::string& wanted, const std::string& text) {
  const sks::SettingInfo* info = findParameter(wanted);
  if (!info) {
    throw sks::Error(sks::ErrorCode::bad_usage,
                     "unknown parameter '" + wanted + "': did you mean '" + nearestParameter(wanted) + "'?");
  }
  if (!isNodeSetting(wanted)) return sks::setSetting(configuration.detector, wanted, text);
  forEachNodeSetting(configuration.node, [&](const std::string& key, auto& value, const sks::About&) {
    if (key == wanted) assign(value, *info, text);
  });
}

std::string nearestParameter(const std::string& key) {
  const auto distance = [&](const sks::SettingInfo& info) {
    return std::min(sks::editDistance(key, info.key), sks::editDistance(lastPart(key), lastPart(info.key)) + 1);
  };
  const auto nearer = [&](const sks::SettingInfo& a, const sks::SettingInfo& b) { return distance(a) < distance(b); };
  return std::min_element(parameterInfos().begin(), parameterInfos().end(), nearer)->key;
}

bool isChangeable(const std::string& key) {
  return key != "codebook" && key != "codebook_directory" && key != "dataset_directory" && key != "service_timeout";
}

}  // namespace sks_detector
