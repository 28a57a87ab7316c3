// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include <sks_detector/cloud.hpp>

namespace sks::test {

/// A surface with bumps that are nowhere alike, seen from the origin at a distance of 1 m.
inline Cloud bumps(bool color = false) {
  Cloud cloud;
  for (float x = -0.09f; x < 0.09f; x += 0.003f) {
    for (float y = -0.07f; y < 0.07f; y += 0.003f) {
      const float z = 0.02f * std::sin(60 * x + 300 * x * y) + 0.015f * std::cos(75 * y + 20 * x) + x * x * 4;
      cloud.points.emplace_back(x, y, 1 + z);
      if (color) cloud.colors.push_back({std::uint8_t(128 + 1000 * x), std::uint8_t(128 + 1500 * y), 90});
    }
  }
  cloud.width = std::uint32_t(cloud.points.size());
  return cloud;
}

}  // namespace sks::test
