// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <sks_detector/stages/matching.hpp>

#include "core/matching/lowest_bounds.hpp"
#include "core/matching/merged_words.hpp"
#include "core/matching/searched_words.hpp"
#include "core/matching/word_clusters.hpp"
#include "core/matching/word_codes.hpp"

namespace sks {

/// How much of its words a search looks at.
struct SearchEffort {
  bool all = true;  ///< and the nearest one is found for certain; else in clusters of words, as follows
  std::size_t clusters_for_each = 8;                  ///< that is visited, of the number of clusters; at least and at
  std::size_t least_visited = 24, most_visited = 80;  ///< most so many
  std::size_t words_for_each = 256;                   ///< that is looked at closer, of the number of words; at least
  std::size_t least_kept = 160, most_kept = 256;      ///< and at most so many
  std::size_t measured = 0;  ///< most words of a group whose full distances are computed; 0: as may be the nearest

  static SearchEffort exact() { return {}; }
  /// Nearly all of the nearest words are found.
  static SearchEffort thorough() { return {false}; }
  /// About one in fifty is missed, in half of the time.
  static SearchEffort quick() { return {false, 13, 24, 80, 400, 160, 256, 4}; }
  /// For words of which it matters only that there is some as near.
  static SearchEffort glance() { return {false, 8, 8, 8, 256, 32, 32, 4}; }
};

/// Search for the codewords that are nearest under chi squared: coarse lower bounds of all words, finer ones of those
/// that can still win, full distances of the few that are left. Exact; or, for large codebooks, only among the words of
/// the clusters whose centers are nearest, of which those of the lowest bounds are looked at closer. Words may belong
/// to groups (objects): then the nearest word of each group is found that is nearly as near as the nearest of all.
class NearestWord {
public:
  /// The search of one query.
  struct Search {
    const float* histogram;
    float factor;
    WordCodes::CodedQuery query;
    float best;                          // distance of any word so far
    std::vector<float> best_of_group;    // ... of a group
    std::vector<float> lowest_of_group;  // bound so far of a group
    LowestBounds found;                  // words that may be nearest
  };

  /// Buffers of one thread.
  struct Workspace {
    HellingerAxes::Projection projection;
    std::vector<Search> searches;
    std::vector<float> bounds;                              // of a tile of words, of several queries
    std::vector<std::uint32_t> selected;                    // positions in `bounds`
    std::vector<float> merged;                              // bins of one query
    std::vector<float> sorted;                              // bounds, in part
    std::vector<float> centers;                             // distances of several queries to them
    std::vector<std::uint64_t> visits;                      // cluster and search, to be made in this order
    std::vector<std::pair<float, std::uint32_t>> likely;    // lowest bound and its slot, of each group
    std::array<std::vector<float>, 2> words;                // bins of two words
    std::vector<std::pair<double, std::uint32_t>> nearest;  // distance and word of each group
  };

  /// @param group_of_word below `groups`; empty: all belong to one
  /// @throws Error(bad_data) naming word and bin for a value that is negative or not finite
  NearestWord(SearchedWords words, const SearchEffort& effort, const std::vector<std::uint32_t>& group_of_word = {},
              std::size_t groups = 1);

  const SearchedWords& words() const { return words_; }

  /// Finds the nearest words of all queries; of equally near words the first. There must be words.
  /// @param factor at least 1; the nearest word of a group is found where it is within this factor of the distance of
  ///        the nearest of all
  /// @param limits of the distance of each query's nearest words, on which less time is spent; none: nullptr
  /// @return one for each query and group, query by query; of infinite distance where none was found
  /// @throws Error(incompatible) if the descriptors' sizes differ
  std::vector<Match> find(const DescriptorMatrix& queries, float factor, int threads,
                          const float* limits = nullptr) const;

private:
  bool exact() const { return effort_.all || clusters_.size() == 1; }
  std::uint32_t groupOf(std::uint32_t slot) const { return groups_ == 1 ? 0 : group_of_slot_[slot]; }
  /// Its bins, perhaps in the buffer.
  const float* wordAt(std::uint32_t slot, std::vector<float>& buffer) const;
  void remember(Search& search, std::uint32_t slot, float distance) const;
  void measureLikely(Search& search, std::uint32_t slot, float bound, Workspace& work) const;
  void measureLikelyOfGroups(Search& search, Workspace& work) const;
  void keepLowestOfGroups(Search& search, Workspace& work) const;
  float limitOfTile(const Search& search, std::size_t first_block) const;
  template <typename HighestWithin>
  void dropHopeless(Search& search, HighestWithin&& highest_within) const;
  template <typename HighestWithin>
  void measurePromising(Search& search, HighestWithin&& highest_within, Workspace& work) const;
  void find(const DescriptorMatrix& queries, std::size_t first, std::size_t count, float factor, const float* limits,
            Match* matches, Workspace& work) const;
  void start(Search& search, const float* histogram, float factor, float limit, Workspace& work) const;
  void visitAll(std::size_t count, Workspace& work) const;
  void visitNearest(std::size_t count, Workspace& work) const;
  void chooseClusters(std::size_t first, std::size_t count, Workspace& work) const;
  void visitCluster(std::size_t cluster, Search* const* searches, std::size_t count, Workspace& work) const;
  std::size_t mostKept() const;
  void visit(std::size_t first_block, std::size_t blocks, Search* const* searches, std::size_t count,
             Workspace& work) const;
  void finish(Search& search, Match* matches, Workspace& work) const;

  SearchedWords words_;
  SearchEffort effort_;
  WordCodes codes_;
  WordClusters clusters_;
  CodeTable table_;  // a code for each slot of the clusters
  MergedWords merged_;
  std::size_t groups_;
  std::vector<std::uint32_t> group_of_slot_;                // where there are several
  std::vector<std::vector<std::uint32_t>> groups_of_tile_;  // ... and the search is exact
};

}  // namespace sks
