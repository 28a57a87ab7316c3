// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace sks::test {

/// What the synthetic camera sees, by formula: a sloping board, a red box in front of it left of the middle, and a
/// strip at the left edge where nothing is measured.
struct SyntheticView {
  int width;
  int height;

  double focalLength() const { return 525.0 * width / 640.0; }
  double slopeX(int u) const { return (u - 0.5 * (width - 1)) / focalLength(); }
  double slopeY(int v) const { return (v - 0.5 * (height - 1)) / focalLength(); }

  bool isBox(int u, int v) const {
    return slopeX(u) > -0.25 && slopeX(u) < -0.05 && slopeY(v) > -0.05 && slopeY(v) < 0.15;
  }

  /// [mm]; 0: nothing is measured
  std::uint16_t depth(int u, int v) const {
    if (u < width / 64) return 0;
    if (isBox(u, v)) return 800;
    return std::uint16_t(std::lround(1200.0 / (1.0 + 0.5 * slopeY(v))));
  }

  /// Red, green, blue.
  std::array<std::uint8_t, 3> color(int u, int v) const {
    if (isBox(u, v)) return {200, 30, 20};
    return {40, std::uint8_t(255 * u / width), 90};
  }
};

}  // namespace sks::test
