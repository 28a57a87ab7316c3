// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

namespace sks {

/// An object at a position, with the correspondences that agree on its pose. Frame of the scene.
struct Hypothesis {
  std::uint32_t object = 0;
  std::uint32_t view = 0;  ///< the training view whose frame T_scene_model maps; of a shared frame the most similar one
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();  ///< box centre, axes parallel to the model's
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();             ///< full extents [m]
  /// Covariance of the pose: shift of the centre of the box [m], and rotation vector, along the axes of the model;
  /// zeros: not known.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  bool stands = false;                 ///< found without votes: something stands alone there, as the object would
  double density = 0;                  ///< of the inliers' votes at their maximum (eq. 3 without its constant)
  double evidence = 0;                 ///< for the pose: of all that was seen of it, or of its votes alone
  std::uint32_t votes = 0;             ///< votes at the maximum before RANSAC
  std::vector<std::uint32_t> inliers;  ///< indices of the votes that RANSAC did not remove
};

}  // namespace sks
