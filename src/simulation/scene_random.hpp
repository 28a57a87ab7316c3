// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <sks_detector/cloud.hpp>

#include "simulation/pixel_random.hpp"

namespace sks {

/// A number in [low, high).
inline double between(PixelRandom& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

/// One of 0 ... count - 1.
inline std::size_t below(PixelRandom& random, std::size_t count) {
  return std::min(count - 1, std::size_t(random.uniform() * double(count)));
}

/// A colour whose channels lie in [low, high).
inline Rgb anyColor(PixelRandom& random, double low, double high) {
  const auto channel = [&] { return std::uint8_t(between(random, low, high)); };
  const std::uint8_t r = channel(), g = channel();
  return {r, g, channel()};
}

}  // namespace sks
