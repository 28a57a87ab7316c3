// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/chi_squared.hpp"

namespace sks {

/// How the bins of a descriptor are merged into fewer: bin i goes to group[i].
///
/// (a-b)^2/(a+b) is jointly convex and homogeneous, so the chi squared distance of sums over groups of bins is never
/// above that of the bins: an exact lower bound at a fraction of the cost.
struct BinMerge {
  std::vector<std::uint16_t> group;
  std::size_t size = 0;    ///< number of groups
  std::size_t padded = 0;  ///< the same, rounded up to whole SIMD blocks

  void setSize(std::size_t groups) {
    size = groups;
    padded = (groups + block_words - 1) / block_words * block_words;
  }

  /// Writes the sums of a descriptor, and zeros up to `padded`.
  void apply(const float* descriptor, float* sums) const;
};

/// A cascade of merges for descriptors of the given size, coarse to fine; every group of one is a union of groups of
/// the next, so bounds only grow. Sizes that are neither SHOT's nor CSHOT's merge runs of neighbouring bins.
std::vector<BinMerge> boundCascade(std::size_t descriptor_size);

}  // namespace sks
