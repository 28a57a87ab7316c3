// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/descriptors.hpp>

namespace sks {

/// Groups of consecutive bins: group k holds bins begin[k] to begin[k + 1] - 1.
using BinGroups = std::vector<std::size_t>;

/// Each of the histograms that a descriptor is made of cut into `parts` groups; sizes that are neither SHOT's nor
/// CSHOT's are taken as histograms of 11 bins.
BinGroups groupBins(std::size_t descriptor_size, std::size_t parts);

/// Sums over groups of bins. (a-b)^2/(a+b) is jointly convex and homogeneous, so the chi squared distance of the sums
/// is never above that of the bins: an exact lower bound at a fraction of the cost.
std::vector<float> mergeBins(const float* descriptor, const BinGroups& groups);

}  // namespace sks
