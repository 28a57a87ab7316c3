// SPDX-License-Identifier: BSD-3-Clause
// What the rounds of point-to-plane ICP have in common, however pairs are found.
#pragma once

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/verification/motion_prior.hpp"

namespace sks {

constexpr std::size_t fewest_pairs = 6;   // as many as a rigid motion has degrees of freedom
constexpr float normal_agreement = 0.7f;  // cosine; about 45 degrees

/// Farthest that the pairs of a round may lie apart [m]: shrinks geometrically from the start to the end distance.
double pairDistance(const RefinementSettings& settings, int round);

/// Normal equations of the small motion that brings the model's points onto the planes of their correspondences, in
/// least squares with Tukey weights.
class PointToPlane {
public:
  /// @param pivot that the motion turns about; near the points, which keeps the equations well conditioned
  explicit PointToPlane(const Eigen::Vector3d& pivot) : pivot_(pivot) {}

  /// A point of the model, mapped into the scene, and its corresponding point there with its normal.
  /// @param scale [m] pairs whose distance from the plane is larger do not count
  void add(const Eigen::Vector3d& model, const Eigen::Vector3d& scene, const Eigen::Vector3d& normal, double scale);

  /// @param sums upper triangle of the matrix, row by row, and then the right side
  void set(const double* sums);

  /// Holds what the pairs tell little about. @param T_scene_model the pose that motion() moves
  void hold(const MotionPrior& prior, const Eigen::Isometry3d& T_scene_model);

  Eigen::Isometry3d motion() const;

private:
  Eigen::Vector3d pivot_;
  Eigen::Matrix<double, 6, 6> A_ = Eigen::Matrix<double, 6, 6>::Zero();  // its upper triangle
  Eigen::Matrix<double, 6, 1> b_ = Eigen::Matrix<double, 6, 1>::Zero();
};

}  // namespace sks
