// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/matching/bound_cascade.hpp"
#include "core/matching/searched_words.hpp"

namespace sks {

/// Lower bounds of the chi squared distances to single words, from bins merged and kept in 16 bits.
class MergedWords {
public:
  MergedWords() = default;
  /// @param order the word of each slot
  MergedWords(const SearchedWords& words, const std::vector<std::uint32_t>& order);

  void merge(const float* histogram, std::vector<float>& merged) const;

  /// Distances of the merged histogram to those of some slots.
  void distances(const std::vector<float>& merged, const std::vector<std::uint32_t>& slots,
                 std::vector<float>& distances) const;

  /// The highest distance of the merged histogram to a word that may be within `distance`.
  float highestWithin(float distance) const;

private:
  BinMerge merge_;
  std::vector<std::uint16_t> rows_;  // bfloat16
  float rounding_ = 0;               // the most by which rounding moves a word (root of chi squared, a metric)
};

}  // namespace sks
