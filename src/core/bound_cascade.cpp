// SPDX-License-Identifier: BSD-3-Clause
#include "core/bound_cascade.hpp"

#include <algorithm>
#include <map>

#include <sks_detector/descriptors.hpp>

namespace sks {
namespace {

/// One level for (C)SHOT: neighbouring sectors in pairs, husks kept apart or not, and value bins cut at `cuts`.
/// Measured on Kinect scenes: the mass lies in few value bins, so these cuts lose least.
struct Level {
  bool merge_husks;
  std::vector<std::size_t> shape_cuts, color_cuts;  ///< first value bin of each group
};

std::vector<std::size_t> eachBin(std::size_t bins) {
  std::vector<std::size_t> cuts(bins);
  for (std::size_t i = 0; i < bins; ++i) cuts[i] = i;
  return cuts;
}

std::size_t part(const std::vector<std::size_t>& cuts, std::size_t value) {
  return std::size_t(std::upper_bound(cuts.begin(), cuts.end(), value) - cuts.begin()) - 1;
}

BinMerge shotMerge(const Level& level, std::size_t descriptor_size) {
  constexpr std::size_t shape_bins = 11, color_bins = 31;  // value bins of a volume
  BinMerge merge;
  std::map<std::vector<std::size_t>, std::uint16_t> ids;
  for (std::size_t i = 0; i < descriptor_size; ++i) {
    const bool color = i >= shot_size;
    const std::size_t bins = color ? color_bins : shape_bins, local = color ? i - shot_size : i;
    const std::size_t volume = local / bins, value = local % bins;
    const std::size_t sector_pair = volume / 8, husk = volume / 2 % 2, half = volume % 2;
    const std::vector<std::size_t> key{color, sector_pair, level.merge_husks ? 0 : husk, half,
                                       part(color ? level.color_cuts : level.shape_cuts, value)};
    merge.group.push_back(ids.emplace(key, std::uint16_t(ids.size())).first->second);
  }
  merge.setSize(ids.size());
  return merge;
}

BinMerge runMerge(std::size_t run, std::size_t descriptor_size) {
  BinMerge merge;
  for (std::size_t i = 0; i < descriptor_size; ++i) merge.group.push_back(std::uint16_t(i / run));
  merge.setSize((descriptor_size + run - 1) / run);
  return merge;
}

}  // namespace

void BinMerge::apply(const float* descriptor, float* sums) const {
  std::fill(sums, sums + padded, 0.0f);
  for (std::size_t i = 0; i < group.size(); ++i) sums[group[i]] += descriptor[i];
}

std::vector<BinMerge> boundCascade(std::size_t descriptor_size) {
  if (descriptor_size != shot_size && descriptor_size != cshot_size) {
    return {runMerge(16, descriptor_size), runMerge(4, descriptor_size), runMerge(2, descriptor_size)};
  }
  const std::vector<std::size_t> few_colors{0, 2, 5}, some_colors{0, 1, 2, 3, 4, 5, 7, 9, 12, 16, 22};
  return {shotMerge({true, {0, 5, 8}, few_colors}, descriptor_size),
          shotMerge({true, eachBin(11), some_colors}, descriptor_size),
          shotMerge({false, eachBin(11), some_colors}, descriptor_size)};
}

}  // namespace sks
