// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sks::tools {

/// Runs a program without a shell and waits for it; what it prints goes where our own messages go.
/// @param arguments the path of the program, then its arguments
/// @return its exit status; 128 and the signal's number where a signal ended it
/// @throws Error(bad_file) naming the program if it cannot be started
int runProgram(const std::vector<std::string>& arguments);

}  // namespace sks::tools
