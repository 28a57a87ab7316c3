// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/turned_poses.hpp"

#include <algorithm>

namespace sks {
namespace {

constexpr double square = 0.9;  // ratio of edges from which on a side of the box counts as square

}  // namespace

std::vector<Eigen::Isometry3d> turnedPoses(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& size) {
  std::vector<Eigen::Isometry3d> poses;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = size[(axis + 1) % 3], b = size[(axis + 2) % 3];
    const bool is_square = std::min(a, b) >= square * std::max(a, b);
    for (int quarters = is_square ? 1 : 2; quarters <= 3; quarters += is_square ? 1 : 2) {
      const Eigen::AngleAxisd turn(0.5 * EIGEN_PI * quarters, Eigen::Vector3d::Unit(axis));
      poses.push_back(T_scene_model * Eigen::Translation3d(center) * turn * Eigen::Translation3d(-center));
    }
  }
  return poses;
}

}  // namespace sks
