// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "core/verification/pose_information.hpp"

namespace sks {

/// Where an object is expected, for the motions that its surface tells little about: the turn of a bottle about its
/// axis, the shift of a sheet within its plane. Added to the equations of point-to-plane ICP it holds these, which
/// would else follow the noise of the normals, and leaves all others as they are.
class MotionPrior {
public:
  /// @param surface some of the object's points, `area` for each [m^2]
  /// @param reach farthest that they are from the scene's [m]
  /// @param noise standard deviation of depth there [m]
  MotionPrior(const SurfaceSample& surface, double area, const SceneView& scene, double reach, double noise,
              const Eigen::Isometry3d& T_scene_expected);

  /// Adds to the normal equations of a small motion: rotation vector, and shift of `pivot`.
  /// @param A its upper triangle counts
  /// @param T_scene_model the pose that is moved
  void hold(Matrix6d& A, Vector6d& b, const Eigen::Vector3d& pivot, const Eigen::Isometry3d& T_scene_model) const;

private:
  Eigen::Isometry3d T_expected_scene_;
  Eigen::Vector3d pivot_;             // scene frame
  double radius_ = 1;                 // [m] turns times this are as long as shifts
  Matrix6d motions_;                  // columns: orthogonal, turns in lengths
  Vector6d held_ = Vector6d::Zero();  // weight of the expected pose beside that of the scene, for each of them
};

}  // namespace sks
