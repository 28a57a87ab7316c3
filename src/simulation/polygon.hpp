// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace sks {

using PolygonTriangle = std::array<std::uint32_t, 3>;  ///< indices of corners

/// Cuts a polygon, which may have dents, into triangles of the same orientation. One that crosses itself, or with dents
/// and more than 256 corners, is cut up from its first corner.
/// @param corners three or more, finite
std::vector<PolygonTriangle> triangulate(const std::vector<Eigen::Vector3f>& corners);

}  // namespace sks
