// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detection.hpp>

#include <algorithm>
#include <iterator>

namespace sks {

std::vector<Detection> DetectionResult::above(double threshold) const {
  std::vector<Detection> kept;
  std::copy_if(detections.begin(), detections.end(), std::back_inserter(kept),
               [&](const Detection& d) { return d.score >= threshold; });
  return kept;
}

}  // namespace sks
