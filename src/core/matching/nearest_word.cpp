// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/nearest_word.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <sks_detector/error.hpp>

#include "core/matching/chi_squared.hpp"

namespace sks {
namespace {

constexpr float rounding = 1e-4f;              // above the relative error of single precision distances
constexpr std::size_t tile_blocks = 16;        // whose codes stay in the cache while a batch of queries passes
constexpr std::size_t words_of_cluster = 128;  // about
constexpr std::size_t centers_sampled = 8;     // every one of this many

constexpr float nothing = std::numeric_limits<float>::infinity();

/// The largest distance of a word of the group that may be wanted.
float limitOf(const NearestWord::Search& search, std::uint32_t group) {
  return std::min(search.best_of_group[group], search.factor * search.best) * (1 + rounding);
}

/// Makes of a query's lower bounds estimates, which rank words better: what the axes leave over of two histograms
/// points the same way in bounds, but is only somewhat alike in truth. Estimates may be above the distance.
void estimate(WordCodes::CodedQuery& query) {
  std::int16_t& left_over = query.vector.code[code_size - 1];
  const float square = query.vector.unit * float(left_over) * query.vector.unit * float(left_over);
  left_over = std::int16_t(0.7f * float(left_over));
  query.slack += 2 * 0.3f * square;
}

}  // namespace

NearestWord::NearestWord(SearchedWords words, const SearchEffort& effort,
                         const std::vector<std::uint32_t>& group_of_word, std::size_t groups)
    : words_(std::move(words)), effort_(effort), groups_(groups) {
  words_.checkHistograms();
  if (words_.rows() == 0) return;
  codes_ = WordCodes(words_);
  const std::vector<CodedVector> codes = codes_.encode(words_);
  clusters_ = WordClusters(codes, effort.all ? 1 : words_.rows() / words_of_cluster);
  const std::vector<std::uint32_t>& order = clusters_.order();
  table_ = CodeTable(order.size());
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    if (order[slot] != WordClusters::no_word) table_.set(slot, codes[order[slot]]);
  }
  merged_ = MergedWords(words_, order);
  if (groups == 1) return;
  group_of_slot_.resize(order.size());
  groups_of_tile_.resize(table_.blocks() / tile_blocks + 1);
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    if (order[slot] == WordClusters::no_word) continue;
    group_of_slot_[slot] = group_of_word[order[slot]];
    std::vector<std::uint32_t>& tile = groups_of_tile_[slot / (tile_blocks * block_words)];
    if (std::find(tile.begin(), tile.end(), group_of_slot_[slot]) == tile.end()) tile.push_back(group_of_slot_[slot]);
  }
}

const float* NearestWord::wordAt(std::uint32_t slot, std::vector<float>& buffer) const {
  return words_.row(clusters_.order()[slot], buffer);
}

/// A distance that was measured may be the best one so far.
void NearestWord::remember(Search& search, std::uint32_t slot, float distance) const {
  float& of_group = search.best_of_group[groupOf(slot)];
  of_group = std::min(of_group, distance);
  search.best = std::min(search.best, distance);
}

/// The word of the lowest bound is likely to be near: its distance rules most others out.
void NearestWord::measureLikely(Search& search, std::uint32_t slot, float bound, Workspace& work) const {
  float& lowest = search.lowest_of_group[groupOf(slot)];
  if (!(bound < lowest)) return;
  lowest = bound;
  remember(search, slot, chiSquaredFast(search.histogram, wordAt(slot, work.words[0]), words_.cols()));
}

/// Measures the likely word of each group where it may be near enough, the nearest one first.
void NearestWord::measureLikelyOfGroups(Search& search, Workspace& work) const {
  const LowestBounds& found = search.found;
  std::vector<std::pair<float, std::uint32_t>>& likely = work.likely;
  likely.assign(groups_, {nothing, 0});
  for (std::size_t i = 0; i < found.slots.size(); ++i) {
    auto& of_group = likely[groupOf(found.slots[i])];
    if (found.bounds[i] < of_group.first) of_group = {found.bounds[i], found.slots[i]};
  }
  std::sort(likely.begin(), likely.end());
  for (const auto& [bound, slot] : likely) {
    if (bound > merged_.highestWithin(limitOf(search, groupOf(slot)))) break;
    remember(search, slot, chiSquaredFast(search.histogram, wordAt(slot, work.words[0]), words_.cols()));
  }
}

/// Of each group only some words, those of the lowest bounds: merged bins keep nearly all of a distance.
void NearestWord::keepLowestOfGroups(Search& search, Workspace& work) const {
  LowestBounds& found = search.found;
  std::vector<std::pair<float, std::uint32_t>>& lowest = work.likely;  // bounds and slots, group by group, ascending
  lowest.assign(groups_ * effort_.measured, {nothing, 0});
  for (std::size_t i = 0; i < found.slots.size(); ++i) {
    auto* of_group = &lowest[groupOf(found.slots[i]) * effort_.measured];
    std::pair<float, std::uint32_t> one{found.bounds[i], found.slots[i]};
    for (std::size_t k = 0; k < effort_.measured; ++k) {
      if (one < of_group[k]) std::swap(one, of_group[k]);
    }
  }
  found.slots.clear();
  found.bounds.clear();
  for (const auto& [bound, slot] : lowest) {
    if (bound == nothing) continue;
    found.slots.push_back(slot);
    found.bounds.push_back(bound);
  }
}

/// The largest distance of a word of the tile that may be wanted.
float NearestWord::limitOfTile(const Search& search, std::size_t first_block) const {
  if (groups_ == 1) return limitOf(search, 0);
  if (!exact()) return search.factor * search.best * (1 + rounding);
  float limit = 0;
  for (const std::uint32_t group : groups_of_tile_[first_block / tile_blocks]) {
    limit = std::max(limit, limitOf(search, group));
  }
  return limit;
}

/// @param highest_within the highest bound of a word within a distance
template <typename HighestWithin>
void NearestWord::dropHopeless(Search& search, HighestWithin&& highest_within) const {
  LowestBounds& found = search.found;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.slots.size(); ++i) {
    if (found.bounds[i] > highest_within(limitOf(search, groupOf(found.slots[i])))) continue;
    found.slots[kept] = found.slots[i];
    found.bounds[kept++] = found.bounds[i];
  }
  found.slots.resize(kept);
  found.bounds.resize(kept);
}

/// Distances in place of bounds, two at a time; `nothing` for words that those before them rule out.
/// @param highest_within the highest bound of a word within a distance
template <typename HighestWithin>
void NearestWord::measurePromising(Search& search, HighestWithin&& highest_within, Workspace& work) const {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const std::size_t bins = words_.cols(), count = search.found.slots.size();
  const auto keep = [&](std::size_t i, float distance) {
    search.found.bounds[i] = distance;
    remember(search, search.found.slots[i], distance);
  };
  std::size_t waiting = none;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t slot = search.found.slots[i];
    if (i + 1 < count) words_.prefetch(clusters_.order()[search.found.slots[i + 1]]);
    if (search.found.bounds[i] > highest_within(limitOf(search, groupOf(slot)))) {
      search.found.bounds[i] = nothing;
    } else if (waiting == none) {
      waiting = i;
    } else {
      float distances[2];
      chiSquaredOfTwo(search.histogram, wordAt(search.found.slots[waiting], work.words[0]), wordAt(slot, work.words[1]),
                      bins, distances);
      keep(waiting, distances[0]);
      keep(i, distances[1]);
      waiting = none;
    }
  }
  if (waiting != none) {
    keep(waiting, chiSquaredFast(search.histogram, wordAt(search.found.slots[waiting], work.words[0]), bins));
  }
}

void NearestWord::visit(std::size_t first_block, std::size_t blocks, Search* const* searches, std::size_t count,
                        Workspace& work) const {
  const std::size_t words = blocks * block_words;
  std::array<const CodedVector*, queries_at_once> queries;
  std::array<float*, queries_at_once> bounds;
  for (std::size_t q = 0; q < queries_at_once; ++q) {
    queries[q] = &searches[std::min(q, count - 1)]->query.vector;
    bounds[q] = &work.bounds[q * tile_blocks * block_words];
  }
  codeDistances(queries, table_, first_block, blocks, bounds);
  for (std::size_t q = 0; q < count; ++q) {
    Search& search = *searches[q];
    if (exact()) {
      const std::size_t likely = indexOfSmallest(bounds[q], words);
      if (bounds[q][likely] > limitOfTile(search, first_block) + search.query.slack) continue;
      measureLikely(search, std::uint32_t(first_block * block_words + likely), bounds[q][likely], work);
    }
    const float highest = std::min(search.found.highest(), limitOfTile(search, first_block) + search.query.slack);
    const std::size_t kept = selectUpTo(highest, bounds[q], words, work.selected.data());
    search.found.add(std::uint32_t(first_block * block_words), bounds[q], work.selected.data(), kept);
  }
}

/// How many words of clusters are looked at closer.
std::size_t NearestWord::mostKept() const {
  return std::clamp(words_.rows() / effort_.words_for_each, effort_.least_kept, effort_.most_kept);
}

void NearestWord::finish(Search& search, Match* matches, Workspace& work) const {
  search.found.finish();
  dropHopeless(search, [&](float distance) { return distance + search.query.slack; });
  merged_.merge(search.histogram, work.merged);
  merged_.distances(work.merged, search.found.slots, search.found.bounds);
  // What rounding of the merged bins may have lifted above a limit is not missed among few clusters.
  const auto highestWithin = [&](float distance) { return exact() ? merged_.highestWithin(distance) : distance; };
  measureLikelyOfGroups(search, work);
  dropHopeless(search, highestWithin);
  if (!exact() && effort_.measured > 0) keepLowestOfGroups(search, work);
  measurePromising(search, highestWithin, work);
  dropHopeless(search, [](float distance) { return distance; });
  work.nearest.assign(groups_, {std::numeric_limits<double>::infinity(), 0});
  const auto distanceOf = [&](std::uint32_t word) {
    return chiSquared(search.histogram, words_.row(word, work.words[0]), words_.cols());
  };
  for (std::size_t i = 0; i < search.found.slots.size(); ++i) {
    const std::uint32_t slot = search.found.slots[i], word = clusters_.order()[slot];
    // Between near ties double precision decides, where the search is exact.
    const double distance = exact() ? distanceOf(word) : double(search.found.bounds[i]);
    auto& nearest = work.nearest[groupOf(slot)];
    nearest = std::min(nearest, {distance, word});
  }
  for (std::size_t group = 0; group < groups_; ++group) {
    const auto& [distance, word] = work.nearest[group];
    matches[group] = {0, word, std::isinf(distance) || exact() ? float(distance) : float(distanceOf(word))};
  }
}

void NearestWord::visitAll(std::size_t count, Workspace& work) const {
  for (std::size_t block = 0; block < table_.blocks(); block += tile_blocks) {
    for (std::size_t i = 0; i < count; i += queries_at_once) {
      std::array<Search*, queries_at_once> group;
      const std::size_t size = std::min(queries_at_once, count - i);
      for (std::size_t q = 0; q < size; ++q) group[q] = &work.searches[i + q];
      visit(block, std::min(tile_blocks, table_.blocks() - block), group.data(), size, work);
    }
  }
}

void NearestWord::visitCluster(std::size_t cluster, Search* const* searches, std::size_t count, Workspace& work) const {
  const std::size_t end = clusters_.firstBlock(cluster + 1);
  for (std::size_t block = clusters_.firstBlock(cluster); block < end; block += tile_blocks) {
    visit(block, std::min(tile_blocks, end - block), searches, count, work);
  }
}

/// Appends the clusters near to some queries to the visits, about as many as wanted: a sample of the centers tells how
/// near. The nearest one is to be visited first, since it rules out most words of the others: they have the highest
/// bit.
void NearestWord::chooseClusters(std::size_t first, std::size_t count, Workspace& work) const {
  const CodeTable& centers = clusters_.centers();
  std::array<const CodedVector*, queries_at_once> queries;
  std::array<float*, queries_at_once> distances;
  work.centers.resize(queries_at_once * centers.units.size());
  work.selected.resize(std::max(work.selected.size(), centers.units.size() + selection_room));
  for (std::size_t q = 0; q < queries_at_once; ++q) {
    queries[q] = &work.searches[first + std::min(q, count - 1)].query.vector;
    distances[q] = &work.centers[q * centers.units.size()];
  }
  codeDistances(queries, centers, 0, centers.blocks(), distances);
  const std::size_t visited =
      std::clamp(clusters_.size() / effort_.clusters_for_each, effort_.least_visited, effort_.most_visited);
  for (std::size_t q = 0; q < count; ++q) {
    work.sorted.clear();
    for (std::size_t c = 0; c < clusters_.size(); c += centers_sampled) work.sorted.push_back(distances[q][c]);
    const std::size_t rank = std::min(work.sorted.size() - 1, visited / centers_sampled);
    std::nth_element(work.sorted.begin(), work.sorted.begin() + std::ptrdiff_t(rank), work.sorted.end());
    const std::size_t nearest = indexOfSmallest(distances[q], centers.units.size());
    const std::size_t chosen = selectUpTo(work.sorted[rank], distances[q], centers.units.size(), work.selected.data());
    for (std::size_t i = 0; i < chosen; ++i) {
      const std::uint64_t cluster = work.selected[i];
      const std::uint64_t later = cluster == nearest ? 0 : std::uint64_t(1) << 63;
      work.visits.push_back(later | cluster << 32 | (first + q));
    }
  }
}

void NearestWord::visitNearest(std::size_t count, Workspace& work) const {
  work.visits.clear();
  for (std::size_t i = 0; i < count; i += queries_at_once) {
    chooseClusters(i, std::min(queries_at_once, count - i), work);
  }
  std::sort(work.visits.begin(), work.visits.end());
  std::array<Search*, queries_at_once> group;
  std::size_t size = 0;
  for (std::size_t i = 0; i < work.visits.size(); ++i) {
    const std::uint64_t cluster = work.visits[i] >> 32;
    group[size++] = &work.searches[std::uint32_t(work.visits[i])];
    const bool last = i + 1 == work.visits.size() || work.visits[i + 1] >> 32 != cluster;
    if (size < queries_at_once && !last) continue;
    visitCluster(std::uint32_t(cluster) & 0x7fffffff, group.data(), size, work);
    size = 0;
  }
}

void NearestWord::start(Search& search, const float* histogram, float factor, float limit, Workspace& work) const {
  search.histogram = histogram;
  search.factor = factor;
  codes_.encode(histogram, work.projection, search.query);
  if (!exact()) estimate(search.query);
  search.best = limit;
  search.found.begin(exact() ? 0 : mostKept(), codes_.usualDistance());
  search.best_of_group.assign(groups_, limit);
  search.lowest_of_group.assign(groups_, nothing);
}

void NearestWord::find(const DescriptorMatrix& queries, std::size_t first, std::size_t count, float factor,
                       const float* limits, Match* matches, Workspace& work) const {
  work.searches.resize(std::max(work.searches.size(), count));
  work.bounds.resize(queries_at_once * tile_blocks * block_words);
  work.selected.resize(std::max(work.selected.size(), tile_blocks * block_words + selection_room));
  for (std::size_t i = 0; i < count; ++i) {
    start(work.searches[i], queries.row(first + i), factor, limits != nullptr ? limits[first + i] : nothing, work);
  }
  if (exact()) {
    visitAll(count, work);
  } else {
    visitNearest(count, work);
  }
  for (std::size_t i = 0; i < count; ++i) {
    finish(work.searches[i], matches + i * groups_, work);
    for (std::size_t group = 0; group < groups_; ++group)
      matches[i * groups_ + group].descriptor = std::uint32_t(first + i);
  }
}

std::vector<Match> NearestWord::find(const DescriptorMatrix& queries, float factor, int threads,
                                     const float* limits) const {
  if (queries.cols() != words_.cols()) {
    throw Error(ErrorCode::incompatible, "descriptors of " + std::to_string(queries.cols()) +
                                             " bins cannot be matched with codewords of " +
                                             std::to_string(words_.cols()));
  }
  std::vector<Match> matches(queries.rows() * groups_);
  std::size_t batch = 32;
  if (!exact()) {  // the more at once, the more often a cluster is reused
    batch = std::max(batch, (queries.rows() + 2 * std::size_t(threads) - 1) / (2 * std::size_t(threads)));
  }
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t first = 0; first < queries.rows(); first += batch) {
    static thread_local Workspace work;  // kept from frame to frame
    find(queries, first, std::min(batch, queries.rows() - first), factor, limits, &matches[first * groups_], work);
  }
  return matches;
}

}  // namespace sks
