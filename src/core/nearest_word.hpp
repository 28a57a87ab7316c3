// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <sks_detector/descriptors.hpp>

#include "core/bound_cascade.hpp"

namespace sks {

/// Exact search for the codeword that is nearest under chi squared: coarse lower bounds of all words, finer ones of
/// those that can still win, full distances of the few that are left.
class NearestWord {
public:
  /// Buffers of one thread.
  struct Workspace {
    std::vector<std::vector<float>> query;  // merged by each level
    std::vector<float> coarse;              // bounds of all words
    std::vector<std::uint32_t> candidates;  // words that may still be nearest
    std::vector<float> bounds;              // of the candidates
    std::vector<std::uint32_t> selected;    // places in `candidates`
  };

  /// @throws Error(bad_data) naming word and bin for a value that is negative or not finite
  explicit NearestWord(DescriptorMatrix words);

  const DescriptorMatrix& words() const { return words_; }

  /// Word and distance; the first of equally near words. There must be words.
  std::pair<std::uint32_t, double> find(const float* query, Workspace& work) const;

private:
  float distanceTo(const float* query, std::uint32_t word) const;
  void boundCandidates(std::size_t level, Workspace& work) const;

  DescriptorMatrix words_;
  std::vector<BinMerge> levels_;
  std::vector<float> coarse_;  // level 0 for chiSquaredBlocks(), the last block filled up with the last word
  std::vector<std::vector<float>> finer_;  // the further levels, a row for each word
};

}  // namespace sks
