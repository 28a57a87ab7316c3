// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sks::tools {

/// Runs a plotting script that comes with the program; it says on stderr what is wrong.
/// @param script for example "scripts/plot_evaluation.py"
/// @throws Error(bad_file) if it cannot be run or fails
void runPlotScript(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace sks::tools
