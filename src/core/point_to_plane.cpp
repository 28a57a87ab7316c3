// SPDX-License-Identifier: BSD-3-Clause
#include "core/point_to_plane.hpp"

#include <cmath>

namespace sks {

double pairDistance(const RefinementSettings& settings, int round) {
  const double progress = settings.iterations > 1 ? double(round) / (settings.iterations - 1) : 1.0;
  return settings.start_distance * std::pow(settings.end_distance / settings.start_distance, progress);
}

Eigen::Isometry3d pointToPlaneStep(const std::vector<PointPair>& pairs, double scale) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // turning about the middle keeps the equations well conditioned
  for (const PointPair& pair : pairs) center += pair.model / double(pairs.size());
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 b = Vector6::Zero();
  for (const PointPair& pair : pairs) {
    const double residual = pair.normal.dot(pair.scene - pair.model);
    const double relative = residual / scale;
    if (std::abs(relative) >= 1) continue;
    const double tukey = (1 - relative * relative) * (1 - relative * relative);
    Vector6 row;
    row << (pair.model - center).cross(pair.normal), pair.normal;
    A += tukey * row * row.transpose();
    b += tukey * residual * row;
  }
  // Motions that the surface does not determine (along a plane, about an axis) stay as they are.
  const double damping = 1e-6 * A.trace();
  A.diagonal().array() += damping;
  const Vector6 x = A.ldlt().solve(b);
  const Eigen::Vector3d turn = x.head<3>();
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  if (turn.norm() > 1e-12) step.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  step.translation() = center + x.tail<3>() - step.linear() * center;
  return step;
}

}  // namespace sks
