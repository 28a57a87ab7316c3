// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace sks {

/// Unit vectors that cover the sphere evenly, from +z to -z: a spiral by the golden angle.
inline std::vector<Eigen::Vector3d> evenDirections(int count) {
  const double golden = EIGEN_PI * (3 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(golden * i), radius * std::sin(golden * i), z);
  }
  return directions;
}

}  // namespace sks
