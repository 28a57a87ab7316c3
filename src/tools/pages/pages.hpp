// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace sks::tools {

/// A completion script for bash: subcommands, options, and the values of those that have a list; keys for --set,
/// presets for --config.
std::string completionScript(const CLI::App& app);

/// The manual page sks(1) in the macros of man(7). @param date of the release, YYYY-MM-DD
std::string manualPage(const CLI::App& app, const std::string& version, const std::string& date);

}  // namespace sks::tools
