// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/motion_prior.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace sks {
namespace {

constexpr double expected_motion = 0.003;  // [m] what a scene tells less exactly is rather as it was
constexpr double most_held = 1e4;          // times the weight of the scene
constexpr double least_weight = 1e-3;      // of a motion in the scene's equations, beside the mean

}  // namespace

MotionPrior::MotionPrior(const SurfaceSample& surface, double area, const SceneView& scene, double reach, double noise,
                         const Eigen::Isometry3d& T_scene_expected)
    : T_expected_scene_(T_scene_expected.inverse()) {
  const PoseInformation information(surface, area, scene, reach, T_scene_expected);
  pivot_ = information.pivot;
  radius_ = information.radius;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(information.matrix);
  motions_ = solver.eigenvectors();
  const double unknown = noise * noise / (expected_motion * expected_motion);
  for (int i = 0; i < 6; ++i) held_[i] = std::min(most_held, unknown / std::max(1e-9, solver.eigenvalues()[i]));
}

void MotionPrior::hold(Matrix6d& A, Vector6d& b, const Eigen::Vector3d& pivot,
                       const Eigen::Isometry3d& T_scene_model) const {
  const Eigen::Isometry3d moved = T_scene_model * T_expected_scene_;
  const Eigen::AngleAxisd turn(moved.linear());
  Vector6d so_far;
  so_far << radius_ * turn.angle() * turn.axis(), moved * pivot_ - pivot_;
  // Of a motion about the pivot of the equations that about this one, turns in lengths.
  Matrix6d lengths = Matrix6d::Identity(), back = Matrix6d::Identity();
  const Eigen::Vector3d apart = pivot_ - pivot;
  Eigen::Matrix3d cross;
  cross << 0, -apart.z(), apart.y(), apart.z(), 0, -apart.x(), -apart.y(), apart.x(), 0;
  lengths.topLeftCorner<3, 3>() *= radius_;
  lengths.bottomLeftCorner<3, 3>() = -cross;
  back.topLeftCorner<3, 3>() /= radius_;
  back.bottomLeftCorner<3, 3>() = cross / radius_;
  const Matrix6d scene = back.transpose() * Matrix6d(A.selfadjointView<Eigen::Upper>()) * back;
  const double least = least_weight * scene.trace() / 6;
  for (int i = 0; i < 6; ++i) {
    const Vector6d motion = motions_.col(i);
    const double weight = held_[i] * std::max(least, motion.dot(scene * motion));
    const Vector6d along = lengths.transpose() * motion;
    A += weight * along * along.transpose();
    b -= weight * motion.dot(so_far) * along;
  }
}

}  // namespace sks
