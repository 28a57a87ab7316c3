// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/matching/code_table.hpp"

namespace sks {

/// Clusters of codes (k-means), each of which fills blocks of its own.
class WordClusters {
public:
  static constexpr std::uint32_t no_word = 0xffffffff;

  /// Learns about `count` clusters, 1: all words in their order. Deterministic.
  explicit WordClusters(const std::vector<CodedVector>& words = {}, std::size_t count = 1);

  std::size_t size() const { return first_block_.size() - 1; }
  std::size_t firstBlock(std::size_t cluster) const { return first_block_[cluster]; }

  /// The word of each slot, or no_word.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Centers, for codeDistances().
  const CodeTable& centers() const { return centers_; }

private:
  void arrange(const std::vector<std::uint32_t>& clusters_of_words);

  CodeTable centers_;
  std::vector<std::uint32_t> first_block_;  // of each cluster, and the end
  std::vector<std::uint32_t> order_;
};

}  // namespace sks
