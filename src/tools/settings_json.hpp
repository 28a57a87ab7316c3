// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <sks_detector/settings.hpp>

namespace sks::tools {

/// The value of one setting in its own type: number, boolean or text.
nlohmann::json settingJson(const Settings& settings, const SettingInfo& info);

/// All settings by their dotted keys.
nlohmann::json settingsJson(const Settings& settings);

}  // namespace sks::tools
