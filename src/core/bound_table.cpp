// SPDX-License-Identifier: BSD-3-Clause
#include "core/bound_table.hpp"

#include <algorithm>
#include <numeric>

namespace sks {
namespace {

constexpr std::size_t shape_bins = 11, color_bins = 31;  // of one volume of SHOT and CSHOT

}  // namespace

BinGroups groupBins(std::size_t descriptor_size, std::size_t parts) {
  BinGroups groups;
  for (std::size_t begin = 0; begin < descriptor_size;) {
    const bool color = descriptor_size == cshot_size && begin >= shot_size;
    const std::size_t bins = std::min(color ? color_bins : shape_bins, descriptor_size - begin);
    for (std::size_t k = 0; k < std::min(parts, bins); ++k) groups.push_back(begin + bins * k / std::min(parts, bins));
    begin += bins;
  }
  groups.push_back(descriptor_size);
  return groups;
}

std::vector<float> mergeBins(const float* descriptor, const BinGroups& groups) {
  std::vector<float> sums(groups.size() - 1);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k] = std::accumulate(descriptor + groups[k], descriptor + groups[k + 1], 0.0f);
  }
  return sums;
}

}  // namespace sks
