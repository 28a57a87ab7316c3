// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sks::tools {

/// Where a file lies that comes with the program, for example "config/paper.yaml". Looked for in $SKS_SHARE, then in
/// the share folder beside the installed executable, then in the source tree that it was built from.
/// @throws Error(bad_file) naming the folders that were looked in
std::string sharePath(const std::string& relative);

}  // namespace sks::tools
