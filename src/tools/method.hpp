// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/settings.hpp>

#include "tools/command.hpp"

namespace sks::tools {

/// The methods that can be evaluated.
std::vector<std::string> methodNames();

/// What they are, for --help.
std::string methodHelp();

/// Makes the settings those of a method: what the method starts from, then the options, then what the method fixes.
/// @throws Error(bad_usage), Error(bad_file)
void applyMethod(const std::string& method, const SettingsOptions& options, Settings& settings);

/// The same for isolated objects: the published method then differs in its selection alone, since what it is published
/// with suits scenes. @throws Error(bad_usage), Error(bad_file)
void applyClassificationMethod(const std::string& method, const SettingsOptions& options, Settings& settings);

}  // namespace sks::tools
