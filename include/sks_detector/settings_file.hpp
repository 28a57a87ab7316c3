// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/settings.hpp>

namespace sks {

/// Overlays a YAML settings file (groups as maps: `keypoints: {discard: 0.5}`) on `settings`.
/// @param warnings takes a message with file and line for each old name, which is still understood; may be null
/// @throws Error(bad_usage) naming the file, line and key: unknown (with the nearest known), wrong type, out of range,
///         set twice; Error(bad_file) if it cannot be read or is no YAML. `settings` then stay as they were
void loadSettings(const std::string& path, Settings& settings, std::vector<std::string>* warnings = nullptr);

/// The same from text; `origin` stands in messages for the file's name.
void parseSettings(const std::string& yaml, const std::string& origin, Settings& settings,
                   std::vector<std::string>* warnings = nullptr);

/// All settings as YAML, each with its unit, range and help as a comment where `comments` is set.
std::string settingsToYaml(const Settings& settings, bool comments = false);

}  // namespace sks
