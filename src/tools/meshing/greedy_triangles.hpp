// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace sks::tools {

/// Triangles between points of a surface, by PCL's greedy projection (Marton, Rusu, Beetz 2009): no point is moved, and
/// what is not seen stays open. Deterministic.
/// @param points [m], about `spacing` apart @param normals unit, outwards; one for each point
/// @return three indices of points each, counter-clockwise seen from outside
std::vector<Eigen::Vector3i> greedyTriangles(const std::vector<Eigen::Vector3f>& points,
                                             const std::vector<Eigen::Vector3f>& normals, double spacing);

}  // namespace sks::tools
