// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/matching.hpp>

#include "core/merged_words.hpp"
#include "core/word_codes.hpp"

namespace sks {

/// Exact search for the codewords that are nearest under chi squared: coarse lower bounds of all words, finer ones of
/// those that can still win, full distances of the few that are left.
class NearestWord {
public:
  /// The search of one query.
  struct Search {
    const float* histogram;
    WordCodes::CodedQuery query;
    float lowest_bound;
    float best;                        // distance of any word so far
    std::vector<std::uint32_t> slots;  // words that may be nearest
    std::vector<float> bounds;         // of their distances
  };

  /// Buffers of one thread.
  struct Workspace {
    HellingerAxes::Projection projection;
    std::vector<Search> searches;
    std::vector<float> bounds;            // of a tile of words, of several queries
    std::vector<std::uint32_t> selected;  // places in `bounds`
    std::vector<float> merged;            // bins of one query
  };

  /// @throws Error(bad_data) naming word and bin for a value that is negative or not finite
  explicit NearestWord(DescriptorMatrix words);

  const DescriptorMatrix& words() const { return words_; }

  /// Queries that are best searched together.
  static constexpr std::size_t batch = 32;

  /// Finds the nearest words of `count` queries from `first` on; of equally near words the first. There must be words.
  void find(const DescriptorMatrix& queries, std::size_t first, std::size_t count, Match* matches,
            Workspace& work) const;

private:
  float distanceTo(const Search& search, std::uint32_t slot) const;
  void visit(std::size_t first_block, std::size_t blocks, Search* const* searches, std::size_t count,
             Workspace& work) const;
  Match nearest(Search& search, Workspace& work) const;

  DescriptorMatrix words_;
  std::vector<std::uint32_t> order_;  // the word of each slot
  WordCodes codes_;
  MergedWords merged_;
};

}  // namespace sks
