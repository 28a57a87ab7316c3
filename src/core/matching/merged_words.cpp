// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/merged_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/matching/word_clusters.hpp"

namespace sks {
namespace {

/// Of SHOT's 352 bins 99 % of the distance are left; of CSHOT's 1344 twice as many are needed.
std::size_t mergedBins(std::size_t bins) {
  return bins <= shot_size ? 128 : 256;
}

std::uint32_t bitsOf(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// To the nearest.
std::uint16_t toBfloat16(float value) {
  return std::uint16_t((bitsOf(value) + 0x8000u) >> 16);
}

float fromBfloat16(std::uint16_t half) {
  const std::uint32_t bits = std::uint32_t(half) << 16;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

MergedWords::MergedWords(const SearchedWords& words, const std::vector<std::uint32_t>& order)
    : merge_(learnBoundCascade(words, {mergedBins(words.cols())}).front()), rows_(order.size() * merge_.padded()) {
  std::vector<float> merged(merge_.padded()), kept(merged.size()), buffer;
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    if (order[slot] == WordClusters::no_word) continue;
    merge_.apply(words.row(order[slot], buffer), merged.data());
    std::uint16_t* row = &rows_[slot * merged.size()];
    for (std::size_t i = 0; i < merged.size(); ++i) {
      row[i] = toBfloat16(merged[i]);
      kept[i] = fromBfloat16(row[i]);
    }
    rounding_ = std::max(rounding_, chiSquaredFast(merged.data(), kept.data(), merged.size()));
  }
  rounding_ = 1.001f * std::sqrt(rounding_);
}

void MergedWords::merge(const float* histogram, std::vector<float>& merged) const {
  merged.resize(merge_.padded());
  merge_.apply(histogram, merged.data());
}

void MergedWords::distances(const std::vector<float>& merged, const std::vector<std::uint32_t>& slots,
                            std::vector<float>& distances) const {
  distances.resize(slots.size());
  chiSquaredRows(merged.data(), merged.size(), rows_.data(), slots.data(), slots.size(), distances.data());
}

float MergedWords::highestWithin(float distance) const {
  const float root = std::sqrt(distance) + rounding_;
  return root * root;
}

}  // namespace sks
