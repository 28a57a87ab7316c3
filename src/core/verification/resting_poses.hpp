// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/verification/model_surface.hpp"

namespace sks {

/// How far points extend within a plane.
struct BaseExtent {
  Eigen::Vector3f long_axis = Eigen::Vector3f::UnitX();  ///< unit: the first principal axis
  float length = 0, width = 0;                           ///< along it, and across [m]
};

/// @param points at least one [m] @param up unit normal of the plane
BaseExtent baseExtent(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& up);

/// A way in which an object lies still on a plane.
struct RestingPose {
  Eigen::Vector3f down = Eigen::Vector3f::UnitZ();  ///< unit, model frame: towards the plane
  float height = 0;                                 ///< of the object along it [m]
  float floor = 0;                                  ///< down . p for the points p that touch the plane [m]
  BaseExtent base;                                  ///< of the object along the plane, model frame
  Eigen::Vector3f top = Eigen::Vector3f::Zero();    ///< centroid of what faces up, model frame [m]
  bool flat_top = false;                            ///< it is a plane face about as large as the object

  /// Far longer than wide and high.
  bool isStick() const;
  /// R_scene_model where it lies on something whose normal is `up`, its long axis at an angle [rad] to `axis`, which is
  /// at right angles to `up`.
  Eigen::Matrix3f rotation(const Eigen::Vector3f& up, const Eigen::Vector3f& axis, float angle) const;
};

/// Rotations about the upright axis that are tried: the nearest one is at most 15 degrees off.
constexpr int upright_rotations = 12;

/// Those in which the centre of the surface lies lower than in all rotations around: an object ends in one of these
/// (Wiegley, Rao, Goldberg 1992). The ones that it ends in from most rotations first, at most 12. Deterministic.
std::vector<RestingPose> restingPoses(const ModelSurface& model);

}  // namespace sks
