// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

namespace sks {

/// The one document of a YAML text; null where there is none. Text that nests so deeply that some versions of yaml-cpp
/// exhaust the stack is refused before they see it. YAML::LoadAll() is of no use: some texts never end for it.
/// @param origin stands in messages for the file's name
/// @throws Error(bad_file) naming origin and line: no UTF-8 (a byte order mark is passed over), no YAML, more than one
///         document
YAML::Node parseYaml(const std::string& text, const std::string& origin);

}  // namespace sks
