// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "io/symmetry.hpp"

namespace sks {

/// An object as the BOP errors need it, in the frame of its mesh or cloud.
struct ObjectModel {
  std::vector<Eigen::Vector3d> points;       ///< vertices of the mesh, or points of the cloud [m]
  std::vector<Eigen::Vector3i> triangles;    ///< empty for a cloud
  double diameter = 0;                       ///< greatest distance between two points [m]
  std::vector<Eigen::Isometry3d> symmetries  ///< every motion after which the object looks the same
      = {Eigen::Isometry3d::Identity()};
};

/// All motions of a list of symmetries, the identity first. Rotations about an axis are taken in steps in which no
/// point moves farther than 1 % of the diameter, and combined with the discrete ones.
std::vector<Eigen::Isometry3d> symmetryMotions(const ObjectSymmetries& symmetries);

/// The list that a single symmetry stands for. @param center the axis goes through it
ObjectSymmetries listedSymmetries(const Symmetry& symmetry, const Eigen::Vector3d& center);

/// Greatest distance between two points, to 0.1 %: between those that lie farthest in any of a thousand directions.
double diameterOf(const std::vector<Eigen::Vector3d>& points);

}  // namespace sks
