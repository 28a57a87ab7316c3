// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/matching/chi_squared.hpp"
#include "core/matching/searched_words.hpp"

namespace sks {

/// How the bins of a descriptor are merged into fewer: bin i goes to group[i].
///
/// (a-b)^2/(a+b) is jointly convex and homogeneous, so the chi squared distance of sums over groups of bins is never
/// above that of the bins: an exact lower bound at a fraction of the cost, whatever the groups.
struct BinMerge {
  std::vector<std::uint16_t> group;
  std::size_t size = 0;  ///< number of groups

  /// `size` rounded up to whole SIMD blocks.
  std::size_t padded() const { return (size + row_multiple - 1) / row_multiple * row_multiple; }

  /// Writes the sums of a descriptor, and zeros up to `padded()`.
  void apply(const float* descriptor, float* sums) const;
};

/// Merges of the bins of `words` into each of the given numbers of groups (ascending), coarse to fine. Which bins go
/// together is learned from the words: those whose merging costs pairs of words least of their distance, one merge
/// after the other; there are fewer groups than asked for where few bins hold anything. Every group of one level is a
/// union of groups of the next, so bounds only grow. Deterministic.
std::vector<BinMerge> learnBoundCascade(const SearchedWords& words, const std::vector<std::size_t>& sizes);

}  // namespace sks
