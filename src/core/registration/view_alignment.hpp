// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include "core/registration/captured_view.hpp"

namespace sks {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// How well a small motion of view a against view b is known: a turn [rad] about the axes of b through `pivot`, then a
/// shift [m] along them.
struct MotionInformation {
  Matrix6d matrix = Matrix6d::Zero();               ///< inverse of the covariance, as far as there is one
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< [m], frame of b
};

/// Standard deviations of a motion along the direction in which it is known least.
struct Uncertainty {
  double turn = 0;   ///< [rad]
  double shift = 0;  ///< [m]
};

/// @param radius turns are compared with shifts by what they move at this distance from the pivot [m]
Uncertainty largestUncertainty(const MotionInformation& information, double radius);

/// Which point of the other view is the partner of a point.
enum class Partners {
  along_ray,  ///< what its camera saw in that direction: fast
  nearest     ///< the nearest point: exact
};

/// How views are paired, point by point.
struct AlignmentRounds {
  Partners partners = Partners::nearest;
  int count = 12;
  double start_distance = 0.02, end_distance = 0.008;  ///< farthest pairs of the first and of the last round [m]
  std::size_t stride = 1;                              ///< every so many points look for a partner
};

/// A relative pose at which the surfaces of two views fall on each other.
struct Alignment {
  Eigen::Isometry3d T_b_a = Eigen::Isometry3d::Identity();
  MotionInformation information;
  double deviation = 0;   ///< of points from the surface of the other view: robust standard deviation [m]
  std::size_t pairs = 0;  ///< of the last round; 0: there is nothing to align
};

/// Point-to-plane ICP of both views with each other. The information comes from products of the normals of both views:
/// their noise, which would make a body of revolution look as if its turn were known, is independent and averages out.
Alignment alignViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                     const AlignmentRounds& rounds);

}  // namespace sks
