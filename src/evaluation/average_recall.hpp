// SPDX-License-Identifier: BSD-3-Clause
// Recall at thresholds of a pose error, as the BOP challenge counts it for the task of localization: how many instances
// of an object are in an image is known, and so many detections of it are looked at.
#pragma once

#include <cstddef>
#include <vector>

namespace sks {

/// Errors of the detections of one object in one image, best detection first, to each of its targets: the instances
/// that are to be found.
using ErrorTable = std::vector<std::vector<double>>;

/// How many targets are found with an error below a threshold. Only as many detections as there are targets are looked
/// at. Each in turn takes the target of the smallest error that is still free.
std::size_t foundTargets(const ErrorTable& errors, double threshold);

/// Targets found at each of several thresholds, of a sum of images.
struct RecallCount {
  std::size_t targets = 0;         ///< over all images
  std::vector<std::size_t> found;  ///< at each threshold

  void add(const RecallCount& other);
  /// Mean over the thresholds of the fraction that is found.
  double average() const;
};

/// Counts in one image. @param target_count also where there are no detections
RecallCount countRecall(const ErrorTable& errors, std::size_t target_count, const std::vector<double>& thresholds);

}  // namespace sks
