// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/stages/point_grid.hpp>

namespace sks {

/// Where to put one normal for each point of a grid.
struct NormalArrays {
  float *x, *y, *z;
};

/// Least-squares plane normals, not oriented, of the points within `radius` of each of the grid's points `begin` to
/// `end` - 1; NaN where fewer than `min_neighbors` points lie there. SIMD over points, runtime dispatch; the result at
/// a point does not depend on `begin` and `end`.
void fitPlanesAtPoints(const PointGrid& grid, std::size_t begin, std::size_t end, float radius, int min_neighbors,
                       NormalArrays normals);

/// The same at any position, with the runs of its neighbours from PointGrid::findRuns(). SIMD over neighbours.
Eigen::Vector3f fitPlane(const PointGrid& grid, const Eigen::Vector3f& center, float radius, int min_neighbors,
                         const std::vector<PointGrid::Run>& runs);

/// Unit eigenvector of the smallest eigenvalue of a symmetric matrix (lower triangle read).
Eigen::Vector3f smallestEigenvector(const Eigen::Matrix3d& matrix);

}  // namespace sks
