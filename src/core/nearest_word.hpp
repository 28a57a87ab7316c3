// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/matching.hpp>

#include "core/merged_words.hpp"
#include "core/word_clusters.hpp"
#include "core/word_codes.hpp"

namespace sks {

/// Search for the codewords that are nearest under chi squared: coarse lower bounds of all words, finer ones of those
/// that can still win, full distances of the few that are left. Exact; or, for large codebooks, only among the words of
/// the clusters whose centers are nearest, of which those of the lowest bounds are looked at closer.
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
    std::vector<float> sorted;            // bounds, in part
    std::vector<float> centers;           // distances of several queries to them
    std::vector<std::uint64_t> visits;    // cluster and search, to be made in this order
  };

  /// @throws Error(bad_data) naming word and bin for a value that is negative or not finite
  NearestWord(DescriptorMatrix words, bool exact);

  const DescriptorMatrix& words() const { return words_; }

  /// How many of some queries are best searched together by one of some threads.
  std::size_t batch(std::size_t queries, std::size_t threads) const;

  /// Finds the nearest words of `count` queries from `first` on; of equally near words the first. There must be words.
  void find(const DescriptorMatrix& queries, std::size_t first, std::size_t count, Match* matches,
            Workspace& work) const;

private:
  bool exact() const { return clusters_.size() == 1; }
  float distanceTo(const Search& search, std::uint32_t slot) const;
  void visitAll(std::size_t count, Workspace& work) const;
  void visitNearest(std::size_t count, Workspace& work) const;
  void chooseClusters(std::size_t first, std::size_t count, Workspace& work) const;
  void visitCluster(std::size_t cluster, Search* const* searches, std::size_t count, Workspace& work) const;
  void visit(std::size_t first_block, std::size_t blocks, Search* const* searches, std::size_t count,
             Workspace& work) const;
  Match nearest(Search& search, Workspace& work) const;

  DescriptorMatrix words_;
  WordCodes codes_;
  WordClusters clusters_;
  CodeTable table_;  // a code for each slot of the clusters
  MergedWords merged_;
};

}  // namespace sks
