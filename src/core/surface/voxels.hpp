// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/stages/point_grid.hpp>

namespace sks {

/// Points grouped by the cubes of a grid that is anchored at the frame's origin; cubes in (z, y, x) order.
struct VoxelGroups {
  std::vector<Eigen::Vector3f> centroids;  ///< of the points of each occupied cube
  std::vector<std::uint32_t> begin;        ///< first entry in `points` of each cube, and one past the last
  std::vector<std::uint32_t> points;       ///< indices, ascending within a cube
};

/// @throws Error(bad_data) if the extent of the points is more than two million cubes along an axis
/// The same for any number of threads.
VoxelGroups groupByVoxel(const std::vector<Eigen::Vector3f>& points, double edge, int threads = 1);

/// The centroids alone. The same for any number of threads.
std::vector<Eigen::Vector3f> voxelCentroids(const PointGrid& points, double edge, int threads = 1);

}  // namespace sks
