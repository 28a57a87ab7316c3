// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "ros/camera/camera_frame.hpp"

namespace sks_detector {

/// Puts depth and colour images that were taken together into one frame. Images arrive one by one, each kind in the
/// order of its time.
class FramePairs {
public:
  /// @param tolerance between the times of a pair [us], at least half the time between two images
  explicit FramePairs(std::uint64_t tolerance) : tolerance_(tolerance) {}

  void add(DepthImage image);
  void add(ColorImage image);

  /// Takes out the next pair. A device whose clocks do not agree gets each depth image paired with the newest colour
  /// image, a few images late.
  bool take(CameraFrame& frame);

  void clear();

private:
  void takePair(std::size_t depth, std::size_t color, CameraFrame& frame);

  std::uint64_t tolerance_;
  std::deque<DepthImage> depth_;
  std::deque<ColorImage> color_;
};

}  // namespace sks_detector
