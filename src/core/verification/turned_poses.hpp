// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace sks {

/// The poses in which an object's box lies as it does in this one: rotated by half a turn about each axis of the box
/// through its centre, and by twelfths of a turn about axes across which it is square. Boxes, cans and bowls fit a
/// scene in several of them; only details and colours tell them apart.
/// @param center of the box, model frame [m] @param size of the box along the axes of the model frame [m]
std::vector<Eigen::Isometry3d> turnedPoses(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& size);

}  // namespace sks
