// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/settings_overlay.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

namespace sks {

bool SettingsOverlay::isKey(const std::string& key) const {
  const std::string present = resolve(key, "").key;
  return std::any_of(tables_.begin(), tables_.end(),
                     [&](const BoundSettings& table) { return table.keys->find(present) != nullptr; });
}

bool SettingsOverlay::isGroup(const std::string& name) const {
  return std::any_of(tables_.begin(), tables_.end(),
                     [&](const BoundSettings& table) { return table.keys->isGroup(name); });
}

std::string SettingsOverlay::nearest(const std::string& key) const {
  return nearestKey(infos(), key);
}

Assignment SettingsOverlay::resolve(const std::string& key, const std::string& text) const {
  for (const BoundSettings& table : tables_) {
    Assignment assignment = table.keys->resolve(key, text);
    if (!assignment.old_name.empty()) return assignment;
  }
  return {key, text, ""};
}

std::string SettingsOverlay::get(const std::string& key) const {
  const std::string present = resolve(key, "").key;
  return tableOf(present).get(present);
}

std::string SettingsOverlay::set(const std::string& key, const std::string& text) {
  const Assignment wanted = resolve(key, text);
  const BoundSettings& table = tableOf(wanted.key);
  const auto [before, is_new] = seen_.emplace(wanted.key, wanted.old_name);
  if (!is_new) {
    const std::string& old_name = wanted.old_name.empty() ? before->second : wanted.old_name;
    throw Error(ErrorCode::bad_usage, "'" + wanted.key + "' is set twice" +
                                          (old_name.empty() ? "" : ", also as '" + old_name + "'") + "; keep one");
  }
  table.set(wanted.key, wanted.text);
  return movedText(wanted);
}

void SettingsOverlay::refuse(const std::string& key, const std::string& what) const {
  const std::string present = resolve(key, "").key;
  refuseText(tableOf(present).keys->at(present), what);
}

std::vector<SettingInfo> SettingsOverlay::infos() const {
  std::vector<SettingInfo> all;
  for (const BoundSettings& table : tables_) {
    all.insert(all.end(), table.keys->infos().begin(), table.keys->infos().end());
  }
  return all;
}

const BoundSettings& SettingsOverlay::tableOf(const std::string& key) const {
  for (const BoundSettings& table : tables_) {
    if (table.keys->find(key) != nullptr) return table;
  }
  refuseKey(infos(), key);
}

}  // namespace sks
