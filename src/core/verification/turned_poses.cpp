// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/turned_poses.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr double square = 0.9;   // ratio of edges from which on a side of the box counts as square
constexpr int around_axis = 12;  // rotations about an axis across which it is: a can fits in all of them

Eigen::Isometry3d turned(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& origin, int axis,
                         double angle) {
  return T_scene_model * Eigen::Translation3d(origin) * Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)) *
         Eigen::Translation3d(-origin);
}

}  // namespace

Eigen::Isometry3d turnedAbout(const BodyAxis& body, double angle, const Eigen::Isometry3d& T_scene_model) {
  return turned(T_scene_model, body.origin, body.direction, angle);
}

double turnAbout(const BodyAxis& body, const Eigen::Isometry3d& T_scene_from, const Eigen::Isometry3d& T_scene_to) {
  const Eigen::Quaterniond change(T_scene_from.linear().transpose() * T_scene_to.linear());
  return 2 * std::atan2(change.vec()[body.direction], change.w());
}

std::vector<Eigen::Isometry3d> turnedPoses(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& size, const std::optional<BodyAxis>& body) {
  std::vector<Eigen::Isometry3d> poses;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = size[(axis + 1) % 3], b = size[(axis + 2) % 3];
    const bool is_square = std::min(a, b) >= square * std::max(a, b);
    if (body && body->direction == axis) {
      for (int k = 1; k < turns_about_body; ++k) poses.push_back(turnedAbout(*body, k * body_step, T_scene_model));
      continue;
    }
    const int rotations = is_square ? around_axis : 2;
    for (int k = 1; k < rotations; ++k) {
      poses.push_back(turned(T_scene_model, center, axis, 2 * EIGEN_PI * k / rotations));
    }
  }
  return poses;
}

}  // namespace sks
