// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "core/verification/pose_evidence.hpp"
#include "core/verification/surface_sample.hpp"

namespace sks {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Standard deviation of a depth that a structured-light or stereo camera measures at a range [m] (Nguyen, Izadi,
/// Lovell 2012, eq. 1, for surfaces that face the camera).
double depthNoise(double range);

/// How exactly a cloud tells small motions of an object, from the pairs of point-to-plane ICP.
struct PoseInformation {
  /// @param surface some of the object's points, `area` for each [m^2]
  /// @param reach farthest that they are from the scene's [m]
  PoseInformation(const SurfaceSample& surface, double area, const SceneView& scene, double reach,
                  const Eigen::Isometry3d& T_scene_model);

  Eigen::Vector3d pivot;  ///< that motions turn about, scene frame [m]
  double radius = 1;      ///< [m] turns times this are as long as shifts
  /// Of a motion (rotation vector times the radius, shift): inverse of its covariance where depth has a standard
  /// deviation of 1. Symmetric; where surfaces tell nothing of a motion some of its eigenvalues are about 0.
  Matrix6d matrix;

  /// Along each of these axes: standard error of what the matrix tells, from how much the patches differ. What is not
  /// well above it may be noise of the normals.
  Vector6d standardErrors(const Matrix6d& axes) const;

  /// Variance of depth that goes with the matrix [m^2], from the distances of the pairs: whatever the sensor and
  /// however exact the model. Errors near to each other are alike and average out less, so what pairs pull together
  /// within small cubes is compared with what they would pull alone (cluster-robust variance: Liang and Zeger 1986).
  double depthVariance() const;

private:
  /// What a pair tells of a motion is the product of both: rows of the normals of model and scene.
  struct Pair {
    Vector6d of_model, of_scene;
    Eigen::Vector3f place;  // model frame
    double distance;        // of the scene's point from the surface
  };
  std::vector<Pair> pairs_;
  double patches_ = 1;  // for each pair
};

/// Covariance of a pose: shift of the centre of the box [m], and rotation vector, along the axes of the model.
/// Motions that the cloud does not tell have the deviation of what is possible: as large as the object, or any turn.
/// @param center of the box, model frame [m] @param size largest extent of the box [m]
Matrix6d poseCovariance(const PoseInformation& information, const Eigen::Isometry3d& T_scene_model,
                        const Eigen::Vector3d& center, double size);

/// The same of the pose as it is told: shift of the origin of the model, and rotation vector, along the axes of the
/// scene; and back.
Matrix6d covarianceInScene(const Matrix6d& in_model, const Eigen::Isometry3d& T_scene_model,
                           const Eigen::Vector3d& center);
Matrix6d covarianceInModel(const Matrix6d& in_scene, const Eigen::Isometry3d& T_scene_model,
                           const Eigen::Vector3d& center);

}  // namespace sks
