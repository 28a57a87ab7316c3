// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/settings/settings_overlay.hpp"

namespace sks {

/// Sets what a YAML text says (groups as maps: `keypoints: {discard: 0.5}`, or dotted keys) in any tables. What was set
/// before an error stays set: give copies.
/// @param origin stands in messages for the file's name
/// @param warnings takes what there is to warn about, with file and line; may be null
/// @throws Error(bad_usage) naming file, line and key; Error(bad_file) where it is no YAML
void overlayYaml(const std::string& yaml, const std::string& origin, SettingsOverlay overlay,
                 std::vector<std::string>* warnings);

}  // namespace sks
