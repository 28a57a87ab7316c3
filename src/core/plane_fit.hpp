// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/point_grid.hpp>

namespace sks {

/// Least-squares plane normal of the points within `radius` of each of `count` centres, not oriented; NaN where fewer
/// than `min_neighbors` points lie there. SIMD with runtime dispatch; each result depends on its own centre alone.
void fitPlanes(const PointGrid& grid, const Eigen::Vector3f* centers, std::size_t count, float radius,
               int min_neighbors, Eigen::Vector3f* normals);

/// The same at points `begin` to `end` - 1 of the grid itself.
void fitPlanesAtPoints(const PointGrid& grid, std::size_t begin, std::size_t end, float radius, int min_neighbors,
                       Eigen::Vector3f* normals);

/// Unit eigenvector of the smallest eigenvalue of a symmetric matrix (lower triangle read).
Eigen::Vector3f smallestEigenvector(const Eigen::Matrix3d& matrix);

}  // namespace sks
