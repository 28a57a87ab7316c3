// SPDX-License-Identifier: BSD-3-Clause
#include "ros/reconfigure_messages.hpp"

#include <algorithm>
#include <limits>

#include <sks_detector/error.hpp>

#include "core/settings/value_text.hpp"

namespace sks_detector {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;
using dynamic_reconfigure::Group;
using sks::SettingInfo;

std::string groupOf(const SettingInfo& info) {
  const std::size_t dot = info.key.find('.');
  return dot == std::string::npos ? "Default" : info.key.substr(0, dot);
}

template <typename List, typename Value>
void add(List& list, const std::string& name, const Value& value) {
  list.emplace_back();
  list.back().name = name;
  list.back().value = value;
}

/// Adds a value, given as text that has been checked.
void addValue(Config& config, const SettingInfo& info, const std::string& text) {
  bool yes = false;
  int whole = 0;
  double number = 0;
  if (info.type == "bool" && sks::fromText(text, yes)) {
    add(config.bools, info.key, yes);
  } else if (info.type == "int" && sks::fromText(text, whole)) {
    add(config.ints, info.key, whole);
  } else if (info.type == "double" && sks::fromText(text, number)) {
    add(config.doubles, info.key, number);
  } else {
    add(config.strs, info.key, text);
  }
}

void addBound(Config& config, const SettingInfo& info, double bound) {
  if (info.type == "int") {
    add(config.ints, info.key, int(bound));
  } else if (info.type == "double") {
    add(config.doubles, info.key, bound);
  } else if (info.type == "bool") {
    add(config.bools, info.key, bound == info.range.max);
  } else {
    add(config.strs, info.key, std::string());
  }
}

/// The Python literal by which dynamic_reconfigure lists choices.
std::string editMethod(const SettingInfo& info) {
  std::string list;
  for (const std::string& choice : info.choices) {
    list += (list.empty() ? "" : ", ") + std::string("{'name': '") + choice + "', 'type': 'str', 'value': '" + choice +
            "', 'description': '" + choice + "'}";
  }
  return list.empty() ? "" : "{'enum': [" + list + "], 'enum_description': '" + info.key + "'}";
}

dynamic_reconfigure::ParamDescription describe(const SettingInfo& info) {
  dynamic_reconfigure::ParamDescription description;
  description.name = info.key;
  description.type = info.type == "choice" || info.type == "string" ? "str" : info.type;
  description.description = info.help + (info.unit.empty() ? "" : " [" + info.unit + "]") +
                            (info.binding == sks::Binding::codebook ? "; fixed by the codebook" : "");
  description.edit_method = editMethod(info);
  return description;
}

Group& groupNamed(std::vector<Group>& groups, const std::string& name) {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return group.name == name; });
  if (found != groups.end()) return *found;
  Group group;
  group.name = name;
  group.type = groups.empty() ? "" : "collapse";
  group.id = int(groups.size());
  groups.push_back(group);
  return groups.back();
}

std::vector<const SettingInfo*> changeable() {
  std::vector<const SettingInfo*> infos;
  for (const SettingInfo& info : parameterInfos()) {
    if (isChangeable(info.key)) infos.push_back(&info);
  }
  return infos;
}

std::vector<Group> groups() {
  std::vector<Group> list;
  groupNamed(list, "Default");  // the root
  for (const SettingInfo* info : changeable()) groupNamed(list, groupOf(*info)).parameters.push_back(describe(*info));
  return list;
}

void addGroups(Config& config) {
  static const std::vector<Group> all = groups();
  for (const Group& group : all) {
    config.groups.emplace_back();
    config.groups.back().name = group.name;
    config.groups.back().state = true;
    config.groups.back().id = group.id;
    config.groups.back().parent = group.parent;
  }
}

}  // namespace

ConfigDescription parameterDescriptions() {
  ConfigDescription description;
  description.groups = groups();
  for (const SettingInfo* info : changeable()) {
    addValue(description.dflt, *info, info->default_value);
    addBound(description.min, *info, info->range.min);
    addBound(description.max, *info, info->range.max);
  }
  for (Config* config : {&description.dflt, &description.min, &description.max}) addGroups(*config);
  return description;
}

Config toMessage(const Configuration& configuration) {
  Config config;
  for (const SettingInfo* info : changeable()) addValue(config, *info, getParameter(configuration, info->key));
  addGroups(config);
  return config;
}

Configuration overlaid(Configuration configuration, const Config& message, std::vector<std::string>& warnings) {
  sks::SettingsOverlay overlay(bound(configuration));
  const auto set = [&](const std::string& key, const std::string& text) {
    if (!isChangeable(key)) {
      throw sks::Error(sks::ErrorCode::bad_usage, "~" + key + " is only read when the node starts");
    }
    const std::string warning = overlay.set(key, text);
    if (!warning.empty()) warnings.push_back(warning);
  };
  for (const auto& value : message.bools) set(value.name, sks::toText(bool(value.value)));
  for (const auto& value : message.ints) set(value.name, sks::toText(int(value.value)));
  for (const auto& value : message.doubles) set(value.name, sks::toText(value.value));
  for (const auto& value : message.strs) set(value.name, value.value);
  return configuration;
}

}  // namespace sks_detector
