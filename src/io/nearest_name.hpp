// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sks {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one text into the other.
std::size_t editDistance(const std::string& a, const std::string& b);

/// The candidate with the smallest edit distance to a misspelt `name`, the first of equally near ones; empty if there
/// are no candidates.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace sks
