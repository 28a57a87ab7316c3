// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

namespace sks {

/// Random numbers that depend on what they are for alone, so that pixels can be computed in any order (splitmix64).
class PixelRandom {
public:
  PixelRandom(std::uint64_t seed, std::uint64_t frame, std::uint64_t pixel)
      : state_(mix(mix(mix(seed + step) ^ (frame + step)) ^ (pixel + step))) {}

  /// In [0, 1).
  double uniform() {
    state_ += step;
    return double(mix(state_) >> 11) * 0x1.0p-53;
  }
  /// As if so many uniform numbers had been drawn.
  void skip(unsigned count) { state_ += count * step; }
  /// Two independent standard normal numbers (Box and Muller).
  std::pair<double, double> normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform())), angle = 2 * 3.14159265358979323846 * uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

private:
  static constexpr std::uint64_t step = 0x9E3779B97F4A7C15u;
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace sks
