// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sks_detector/DetectionArray.h>

#include <sks_detector/detection.hpp>

namespace sks_detector {

/// A detection of an array that can be drawn.
struct ShownDetection {
  std::size_t index = 0;  ///< in the array
  /// The same in the next array for what is probably the same thing: by its id where it is tracked, else by its object
  /// and its rank among the detections of that object.
  std::string key;
  sks::Detection detection;  ///< poses valid and normalised, in the frame of the array
};

/// What of an array is drawn, and why the rest is not.
struct ShownDetections {
  std::vector<ShownDetection> shown;
  std::size_t below_threshold = 0;
  std::size_t too_many = 0;      ///< left out, as there are more than can be drawn at once
  std::size_t unusable = 0;      ///< numbers that are not finite, no pose at all, out of all bounds
  std::size_t unnormalized = 0;  ///< drawn, but the length of a quaternion is not 1
  std::string problem;           ///< the first that is unusable or not normalised, in words; empty: none
};

/// Chooses by the score, best first as in the array; never throws for what is in a message.
/// @param threshold lowest score
/// @param most detections to show
ShownDetections chooseShown(const DetectionArray& array, double threshold, std::size_t most);

}  // namespace sks_detector
