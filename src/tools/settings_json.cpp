// SPDX-License-Identifier: BSD-3-Clause
#include "tools/settings_json.hpp"

namespace sks::tools {

nlohmann::json settingJson(const Settings& settings, const SettingInfo& info) {
  const std::string text = getSetting(settings, info.key);
  return info.type == "choice" || info.type == "string" ? nlohmann::json(text) : nlohmann::json::parse(text);
}

nlohmann::json settingsJson(const Settings& settings) {
  nlohmann::json json = nlohmann::json::object();
  for (const SettingInfo& info : settingInfos()) json[info.key] = settingJson(settings, info);
  return json;
}

}  // namespace sks::tools
