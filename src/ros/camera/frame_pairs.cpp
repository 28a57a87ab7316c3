// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/frame_pairs.hpp"

#include <utility>

namespace sks_detector {
namespace {

constexpr std::size_t longest_wait = 4;  // images that may pass before the other image is no longer waited for

std::uint64_t difference(std::uint64_t a, std::uint64_t b) {
  return a < b ? b - a : a - b;
}

/// False where time runs backwards: a recording starts again.
template <typename Image>
bool inOrder(const std::deque<Image>& images, const Image& next) {
  return images.empty() || images.back().time <= next.time;
}

}  // namespace

void FramePairs::add(DepthImage image) {
  if (!inOrder(depth_, image)) clear();
  depth_.push_back(std::move(image));
}

void FramePairs::add(ColorImage image) {
  if (!inOrder(color_, image)) clear();
  color_.push_back(std::move(image));
  if (color_.size() > longest_wait) color_.pop_front();
}

bool FramePairs::take(CameraFrame& frame) {
  if (color_.empty()) {
    if (depth_.size() > longest_wait) depth_.pop_front();
    return false;
  }
  for (std::size_t d = 0; d < depth_.size(); ++d) {
    for (std::size_t c = 0; c < color_.size(); ++c) {
      if (difference(depth_[d].time, color_[c].time) > tolerance_) continue;
      takePair(d, c, frame);
      return true;
    }
  }
  if (depth_.size() <= longest_wait) return false;
  takePair(0, color_.size() - 1, frame);
  return true;
}

void FramePairs::takePair(std::size_t depth, std::size_t color, CameraFrame& frame) {
  frame.depth = std::move(depth_[depth]);
  frame.color = color_[color];  // the next depth image may need it too
  depth_.erase(depth_.begin(), depth_.begin() + std::ptrdiff_t(depth) + 1);
  color_.erase(color_.begin(), color_.begin() + std::ptrdiff_t(color));
}

void FramePairs::clear() {
  depth_.clear();
  color_.clear();
}

}  // namespace sks_detector
