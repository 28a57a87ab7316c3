// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <tuple>

#include <Eigen/Core>

namespace sks {

/// A cube of a grid and the octant that a normal points to: front and back of a thin part stay apart.
using SidedCube = std::tuple<std::int32_t, std::int32_t, std::int32_t, int>;

/// @param edge of the cubes, whose grid is anchored at the origin [m]
inline SidedCube sidedCube(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float edge) {
  const Eigen::Vector3f cube = (point / edge).array().floor();
  const int side = (normal.x() > 0 ? 4 : 0) + (normal.y() > 0 ? 2 : 0) + (normal.z() > 0 ? 1 : 0);
  return {std::int32_t(cube.x()), std::int32_t(cube.y()), std::int32_t(cube.z()), side};
}

}  // namespace sks
