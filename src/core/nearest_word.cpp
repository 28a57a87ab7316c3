// SPDX-License-Identifier: BSD-3-Clause
#include "core/nearest_word.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <sks_detector/error.hpp>

#include "core/chi_squared.hpp"

namespace sks {
namespace {

constexpr float rounding = 1e-4f;        // above the relative error of single precision distances
constexpr std::size_t tile_blocks = 64;  // whose codes stay in the cache while a batch of queries passes

void checkHistograms(const DescriptorMatrix& words) {
  for (std::size_t i = 0; i < words.rows() * words.cols(); ++i) {
    if (words.data()[i] >= 0 && !std::isinf(words.data()[i])) continue;
    throw Error(ErrorCode::bad_data, "codeword " + std::to_string(i / words.cols()) + " is no histogram: bin " +
                                         std::to_string(i % words.cols()) + " is " + std::to_string(words.data()[i]));
  }
}

/// The highest bound of a word that may be nearest.
float highestBound(const NearestWord::Search& search) {
  return search.best * (1 + rounding) + search.query.slack;
}

void dropAbove(float highest, NearestWord::Search& search) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < search.slots.size(); ++i) {
    if (search.bounds[i] > highest) continue;
    search.slots[kept] = search.slots[i];
    search.bounds[kept++] = search.bounds[i];
  }
  search.slots.resize(kept);
  search.bounds.resize(kept);
}

}  // namespace

NearestWord::NearestWord(DescriptorMatrix words) : words_(std::move(words)) {
  checkHistograms(words_);
  if (words_.rows() == 0) return;
  order_.resize(words_.rows());
  std::iota(order_.begin(), order_.end(), 0u);
  codes_ = WordCodes(words_, order_);
  merged_ = MergedWords(words_, order_);
}

float NearestWord::distanceTo(const Search& search, std::uint32_t slot) const {
  return chiSquaredFast(search.histogram, words_.row(order_[slot]), words_.cols());
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
  codeDistances(queries, codes_.table(), first_block, blocks, bounds);
  for (std::size_t q = 0; q < count; ++q) {
    Search& search = *searches[q];
    // The word of the lowest bound is likely to be near: its distance rules most others out.
    const std::size_t likely = indexOfSmallest(bounds[q], words);
    if (bounds[q][likely] < search.lowest_bound) {
      search.lowest_bound = bounds[q][likely];
      search.best = std::min(search.best, distanceTo(search, std::uint32_t(first_block * block_words + likely)));
    }
    const std::size_t kept = selectUpTo(highestBound(search), bounds[q], words, work.selected.data());
    for (std::size_t i = 0; i < kept; ++i) {
      search.slots.push_back(std::uint32_t(first_block * block_words + work.selected[i]));
      search.bounds.push_back(bounds[q][work.selected[i]]);
    }
  }
}

Match NearestWord::nearest(Search& search, Workspace& work) const {
  dropAbove(highestBound(search), search);
  merged_.merge(search.histogram, work.merged);
  merged_.distances(work.merged, search.slots, search.bounds);
  if (!search.slots.empty()) {
    const std::size_t likely = indexOfSmallest(search.bounds.data(), search.bounds.size());
    search.best = std::min(search.best, distanceTo(search, search.slots[likely]));
  }
  dropAbove(merged_.highestWithin(search.best * (1 + rounding)), search);
  for (std::size_t i = 0; i < search.slots.size(); ++i) {
    search.bounds[i] = distanceTo(search, search.slots[i]);
    search.best = std::min(search.best, search.bounds[i]);
  }
  // Between near ties double precision decides.
  dropAbove(search.best * (1 + rounding), search);
  std::pair<double, std::uint32_t> nearest(std::numeric_limits<double>::infinity(), 0);
  for (const std::uint32_t slot : search.slots) {
    const std::uint32_t word = order_[slot];
    nearest = std::min(nearest, {chiSquared(search.histogram, words_.row(word), words_.cols()), word});
  }
  return {0, nearest.second, float(nearest.first)};
}

void NearestWord::find(const DescriptorMatrix& queries, std::size_t first, std::size_t count, Match* matches,
                       Workspace& work) const {
  work.searches.resize(std::max(work.searches.size(), count));
  work.bounds.resize(queries_at_once * tile_blocks * block_words);
  work.selected.resize(tile_blocks * block_words + selection_room);
  for (std::size_t i = 0; i < count; ++i) {
    Search& search = work.searches[i];
    search.histogram = queries.row(first + i);
    codes_.encode(search.histogram, work.projection, search.query);
    search.lowest_bound = search.best = std::numeric_limits<float>::infinity();
    search.slots.clear();
    search.bounds.clear();
  }
  const std::size_t blocks = codes_.table().blocks();
  for (std::size_t block = 0; block < blocks; block += tile_blocks) {
    for (std::size_t i = 0; i < count; i += queries_at_once) {
      std::array<Search*, queries_at_once> group;
      const std::size_t size = std::min(queries_at_once, count - i);
      for (std::size_t q = 0; q < size; ++q) group[q] = &work.searches[i + q];
      visit(block, std::min(tile_blocks, blocks - block), group.data(), size, work);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    matches[i] = nearest(work.searches[i], work);
    matches[i].descriptor = std::uint32_t(first + i);
  }
}

}  // namespace sks
