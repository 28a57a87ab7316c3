// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/verification/body_axis.hpp"

namespace sks {

/// The poses in which an object's box lies as it does in this one: rotated by half a turn about each axis of the box
/// through its centre, and by twelfths of a turn about axes across which it is square; in place of these by
/// twenty-fourths about the axis of its body. Boxes, cans, bowls and mugs fit a scene in several of them; only details
/// and colours tell them apart.
/// @param center of the box, model frame [m] @param size of the box along the axes of the model frame [m]
std::vector<Eigen::Isometry3d> turnedPoses(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& size, const std::optional<BodyAxis>& body);

constexpr int turns_about_body = 24;
constexpr double body_step = 2 * EIGEN_PI / turns_about_body;  ///< [rad]

/// T_scene_model with the model turned by an angle [rad] about the axis of its body.
Eigen::Isometry3d turnedAbout(const BodyAxis& body, double angle, const Eigen::Isometry3d& T_scene_model);

/// The angle about that axis from one pose to another [rad]: its twist.
double turnAbout(const BodyAxis& body, const Eigen::Isometry3d& T_scene_from, const Eigen::Isometry3d& T_scene_to);

}  // namespace sks
