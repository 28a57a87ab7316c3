// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/verification/model_surface.hpp"

namespace sks {

/// A way in which an object lies still on a plane.
struct RestingPose {
  Eigen::Vector3f down = Eigen::Vector3f::UnitZ();  ///< unit, model frame: towards the plane
  float height = 0;                                 ///< of the object along it [m]
  float floor = 0;                                  ///< down . p for the points p that touch the plane [m]
};

/// Those in which the centre of the surface lies lower than in all rotations around: an object ends in one of these
/// (Wiegley, Rao, Goldberg 1992). The ones that it ends in from most rotations first, at most 12. Deterministic.
std::vector<RestingPose> restingPoses(const ModelSurface& model);

}  // namespace sks
