// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/video_mode.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/settings/value_text.hpp"

namespace sks_detector {

std::string toText(const VideoMode& mode) {
  return sks::toText(mode.width) + "x" + sks::toText(mode.height) + " at " + sks::toText(mode.rate) + " Hz";
}

std::size_t nearestMode(const std::vector<VideoMode>& modes, const VideoMode& wanted) {
  const auto distance = [&](const VideoMode& mode) {
    const int size = std::abs(mode.width - wanted.width) + std::abs(mode.height - wanted.height);
    return std::make_pair(size, std::abs(mode.rate - wanted.rate));
  };
  const auto nearer = [&](const VideoMode& a, const VideoMode& b) { return distance(a) < distance(b); };
  return std::size_t(std::min_element(modes.begin(), modes.end(), nearer) - modes.begin());
}

}  // namespace sks_detector
