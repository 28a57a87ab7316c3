// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/settings/settings_table.hpp"

namespace sks {

/// Sets what one source says (a file, the parameter server, a message) in one or several tables. A setting that is set
/// twice, also by its old name, is refused.
class SettingsOverlay {
public:
  explicit SettingsOverlay(std::vector<BoundSettings> tables) : tables_(std::move(tables)) {}

  /// Also for an old key.
  bool isKey(const std::string& key) const;
  bool isGroup(const std::string& name) const;
  std::string nearest(const std::string& key) const;
  Assignment resolve(const std::string& key, const std::string& text) const;
  /// @throws Error(bad_usage) for an unknown key
  std::string get(const std::string& key) const;

  /// Returns what there is to warn about: an old name; else nothing.
  /// @throws Error(bad_usage) for an unknown key, a wrong value, or a setting that was set before
  std::string set(const std::string& key, const std::string& text);
  /// Refuses what is no scalar: "a list", "a map", "nothing". @throws Error(bad_usage)
  [[noreturn]] void refuse(const std::string& key, const std::string& what) const;

private:
  std::vector<SettingInfo> infos() const;
  const BoundSettings& tableOf(const std::string& key) const;

  std::vector<BoundSettings> tables_;
  std::map<std::string, std::string> seen_;  // key, and the old name by which it was set
};

}  // namespace sks
