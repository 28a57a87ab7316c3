// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// Points of which each group's convex hull is a part of a body: the mesh is cut in halves until no part's surface lies
/// deeper than `tolerance` [m] inside of its hull, or 64 parts are there. Hollows (a bowl, a mug) stay hollow.
std::vector<std::vector<Eigen::Vector3f>> convexParts(const Mesh& mesh, float tolerance = 0.004f);

/// The hull's corners. Empty for fewer than four points or points in a plane.
std::vector<Eigen::Vector3f> hullCorners(const std::vector<Eigen::Vector3f>& points);

}  // namespace sks
