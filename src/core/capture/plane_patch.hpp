// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "core/surface/clusters.hpp"

namespace sks {

/// A connected part of a plane.
struct PlanePatch {
  Eigen::Hyperplane<float, 3> plane;    ///< least squares; its normal points to the side of the sensor
  Indices inliers;                      ///< all points at the plane, connected or not, ascending
  std::vector<Eigen::Vector3f> points;  ///< the connected ones; none if there is no plane
  double deviation = 0;                 ///< standard deviation of the points from the plane [m]
};

/// The largest connected part of the plane with the most points (RANSAC, fixed seed).
/// @param points of even density
/// @param tolerance farthest that points of the plane lie from it [m]
/// @param gap what is farther apart is not connected [m]
PlanePatch largestPatch(const std::vector<Eigen::Vector3f>& points, double tolerance, double gap,
                        const Eigen::Vector3f& sensor);

}  // namespace sks
