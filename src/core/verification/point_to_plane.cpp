// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/point_to_plane.hpp"

#include <cmath>

namespace sks {

double pairDistance(const RefinementSettings& settings, int round) {
  const double progress = settings.iterations > 1 ? double(round) / (settings.iterations - 1) : 1.0;
  return settings.start_distance * std::pow(settings.end_distance / settings.start_distance, progress);
}

void PointToPlane::add(const Eigen::Vector3d& model, const Eigen::Vector3d& scene, const Eigen::Vector3d& normal,
                       double scale) {
  const double residual = normal.dot(scene - model);
  const double relative = residual / scale;
  if (std::abs(relative) >= 1) return;
  const double tukey = (1 - relative * relative) * (1 - relative * relative);
  Eigen::Matrix<double, 6, 1> row;
  row << (model - pivot_).cross(normal), normal;
  A_ += tukey * row * row.transpose();
  b_ += tukey * residual * row;
}

void PointToPlane::set(const double* sums) {
  for (int r = 0; r < 6; ++r) {
    for (int c = r; c < 6; ++c) A_(r, c) = *sums++;
  }
  for (int r = 0; r < 6; ++r) b_[r] = *sums++;
}

void PointToPlane::hold(const MotionPrior& prior, const Eigen::Isometry3d& T_scene_model) {
  prior.hold(A_, b_, pivot_, T_scene_model);
}

Eigen::Isometry3d PointToPlane::motion() const {
  Eigen::Matrix<double, 6, 6> damped = A_.selfadjointView<Eigen::Upper>();
  // Motions that the surface does not determine (along a plane, about an axis) stay as they are.
  damped.diagonal().array() += 1e-6 * damped.trace();
  const Eigen::Matrix<double, 6, 1> x = damped.ldlt().solve(b_);
  const Eigen::Vector3d turn = x.head<3>();
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  if (turn.norm() > 1e-12) step.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  step.translation() = pivot_ + x.tail<3>() - step.linear() * pivot_;
  return step;
}

}  // namespace sks
