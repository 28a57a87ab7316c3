// SPDX-License-Identifier: BSD-3-Clause
// What the command line says of its options, as completion and manual need it.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace sks::tools {

/// All subcommands, those of subcommands behind them, each with its words, e.g. "bag info"; the application is "".
struct CommandEntry {
  std::string words;
  const CLI::App* command = nullptr;
};
std::vector<CommandEntry> commandsOf(const CLI::App& app);

/// Subcommands of one command, in their order.
std::vector<const CLI::App*> subcommandsOf(const CLI::App& command);

/// With dashes, the long names first.
std::vector<std::string> namesOf(const CLI::Option& option);

/// What its value is called in the help, e.g. FILE; empty for a flag.
std::string valueName(const CLI::Option& option);

/// The values that it may have, where these are a list.
std::vector<std::string> choicesOf(const CLI::Option& option);

}  // namespace sks::tools
