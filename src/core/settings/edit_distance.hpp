// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sks {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one text into the other. Only the first
/// 100 bytes of each count, so that no text from elsewhere takes long.
std::size_t editDistance(const std::string& a, const std::string& b);

}  // namespace sks
