// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/settings_table.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/edit_distance.hpp"
#include "core/settings/nearest_name.hpp"
#include "core/settings/shown_text.hpp"

namespace sks {
namespace {

std::string lastPart(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

std::string groupOf(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

bool sameValue(const std::string& a, const std::string& b) {
  double x = 0, y = 0;
  return a == b || (fromText(a, x) && fromText(b, y) && x == y);
}

/// What a text must be to be a value of the setting.
std::string expectation(const SettingInfo& info) {
  if (info.type == "bool") return "true or false";
  if (info.type == "choice") return "one of " + allowedValues(info);
  if (info.type == "string") return "text";
  return (info.type == "int" ? "a whole number in " : "a number in ") + allowedValues(info);
}

}  // namespace

const SettingInfo* SettingKeys::find(const std::string& key) const {
  const auto found =
      std::find_if(infos_.begin(), infos_.end(), [&](const SettingInfo& info) { return info.key == key; });
  return found == infos_.end() ? nullptr : &*found;
}

const SettingInfo& SettingKeys::at(const std::string& key) const {
  const SettingInfo* info = find(resolve(key, "").key);
  if (info == nullptr) refuseKey(infos_, key);
  return *info;
}

bool SettingKeys::isGroup(const std::string& name) const {
  const auto in_group = [&](const auto& setting) { return setting.key.rfind(name + ".", 0) == 0; };
  return std::any_of(infos_.begin(), infos_.end(), in_group) ||
         std::any_of(old_settings_.begin(), old_settings_.end(), in_group);
}

Assignment SettingKeys::resolve(const std::string& key, const std::string& text) const {
  for (const OldSetting& old : old_settings_) {
    if (old.key != key) continue;
    if (old.value.empty()) return {old.new_key, text, key};
    if (sameValue(old.value, text)) return {old.new_key, old.new_value, key + " = " + old.value};
  }
  return {key, text, ""};
}

std::string nearestKey(const std::vector<SettingInfo>& infos, const std::string& key) {
  const auto distance = [&](const SettingInfo& info) {
    return std::min(editDistance(key, info.key), editDistance(lastPart(key), lastPart(info.key)) + 1);
  };
  const auto may_mean = [&](const SettingInfo& info) {  // a group that is right says nothing of the rest
    return mayMean(lastPart(key), lastPart(info.key)) || (groupOf(key) != groupOf(info.key) && mayMean(key, info.key));
  };
  const SettingInfo* nearest = nullptr;
  for (const SettingInfo& info : infos) {
    if (may_mean(info) && (nearest == nullptr || distance(info) < distance(*nearest))) nearest = &info;
  }
  return nearest == nullptr ? std::string() : nearest->key;
}

void refuseKey(const std::vector<SettingInfo>& infos, const std::string& key) {
  const std::string nearest = nearestKey(infos, key);
  std::vector<std::string> of_group;
  for (const SettingInfo& info : infos) {
    if (!groupOf(key).empty() && groupOf(info.key) == groupOf(key)) of_group.push_back(info.key);
  }
  const std::string hint = !nearest.empty()   ? ": did you mean '" + nearest + "'?"
                           : of_group.empty() ? "; `sks settings` lists all there are"
                                              : "; there are: " + shownList(of_group);
  throw Error(ErrorCode::bad_usage, "unknown setting '" + shown(key) + "'" + hint);
}

void refuseText(const SettingInfo& info, const std::string& text) {
  throw Error(ErrorCode::bad_usage, info.key + " = " + shown(text) + ": expected " + expectation(info));
}

void checkRange(const SettingInfo& info, double value) {
  if (value >= info.range.min && value <= info.range.max) return;
  throw Error(ErrorCode::bad_usage, info.key + " = " + toText(value) + " is out of range: " + allowedValues(info));
}

std::string movedText(const Assignment& assignment) {
  if (assignment.old_name.empty()) return "";
  const bool only_value = assignment.old_name.find(" = ") != std::string::npos;
  return "'" + assignment.old_name + "' is now called '" + assignment.key +
         (only_value ? " = " + assignment.text : std::string()) + "'; the old name still works";
}

}  // namespace sks
