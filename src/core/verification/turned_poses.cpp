// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/turned_poses.hpp"

#include <algorithm>

namespace sks {
namespace {

constexpr double square = 0.9;   // ratio of edges from which on a side of the box counts as square
constexpr int around_axis = 12;  // rotations about an axis across which it is: a can fits in all of them

}  // namespace

std::vector<Eigen::Isometry3d> turnedPoses(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& size) {
  std::vector<Eigen::Isometry3d> poses;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = size[(axis + 1) % 3], b = size[(axis + 2) % 3];
    const bool is_square = std::min(a, b) >= square * std::max(a, b);
    const int rotations = is_square ? around_axis : 2;
    for (int k = 1; k < rotations; ++k) {
      const Eigen::AngleAxisd turn(2 * EIGEN_PI * k / rotations, Eigen::Vector3d::Unit(axis));
      poses.push_back(T_scene_model * Eigen::Translation3d(center) * turn * Eigen::Translation3d(-center));
    }
  }
  return poses;
}

}  // namespace sks
