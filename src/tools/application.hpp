// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <CLI/App.hpp>

namespace sks::tools {

/// `sks` with all its subcommands.
std::unique_ptr<CLI::App> makeApplication();

}  // namespace sks::tools
