// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/surface/plane_ransac.hpp"
#include "core/verification/resting_poses.hpp"

namespace sks {

/// What a thing shows of itself where it touches others, or lies on them.
struct PilePart {
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();       ///< the way that it faces
  Eigen::Vector3f centroid = Eigen::Vector3f::Zero();  ///< [m]
  BaseExtent base;                                     ///< across `up`
  bool stick = false;                                  ///< else a plane face
};

/// The parts of things that touch: connected plane faces, also cut where they are narrow, and straight sticks.
/// Deterministic.
/// @param points of a connected group, thinned to `spacing` [m]
/// @param up unit normal of the plane that they stand on
/// @param stick_width 0: no sticks are looked for [m]
std::vector<PilePart> pileParts(const OrientedPoints& points, float spacing, const Eigen::Vector3f& up,
                                float stick_width);

}  // namespace sks
