// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

namespace sks {

/// Least-squares rigid transform with `to[i] ~ T * from[i]` (Umeyama without scale); needs at least 3 pairs.
Eigen::Isometry3d fitRigid(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to);

/// The rigid motion on which most pairs agree.
struct RigidConsensus {
  std::vector<std::size_t> inliers;                             ///< ascending; empty if there is none
  Eigen::Isometry3d T_to_from = Eigen::Isometry3d::Identity();  ///< least squares over the inliers
};

/// RANSAC over pairs {from[i], to[i]} with samples of three: every triple where there are no more of them than
/// iterations, else seeded random ones. Same input, same output.
RigidConsensus rigidRansac(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to,
                           const RansacSettings& settings);

}  // namespace sks
