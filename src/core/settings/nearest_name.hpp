// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sks {

/// The candidate with the smallest edit distance to a misspelt `name`, the first of equally near ones; empty if there
/// are no candidates.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace sks
