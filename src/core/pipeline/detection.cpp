// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detection.hpp>

#include <algorithm>
#include <iterator>

#include <sks_detector/thresholds.hpp>

namespace sks {

std::vector<Detection> DetectionResult::above(double threshold) const {
  return above(Thresholds(threshold));
}

std::vector<Detection> DetectionResult::above(const Thresholds& thresholds) const {
  std::vector<Detection> kept;
  std::copy_if(detections.begin(), detections.end(), std::back_inserter(kept),
               [&](const Detection& d) { return thresholds.passes(d); });
  return kept;
}

}  // namespace sks
