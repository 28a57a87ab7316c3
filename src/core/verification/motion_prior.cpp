// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/motion_prior.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

using Matrix6d = MotionPrior::Matrix6d;
using Vector6d = MotionPrior::Vector6d;

constexpr double independent_area = 0.007 * 0.007;  // [m^2] depth errors nearer to each other are alike
constexpr double expected_motion = 0.003;           // [m] what a scene tells less exactly is rather as it was
constexpr double most_held = 1e4;                   // times the weight of the scene
constexpr double least_weight = 1e-3;               // of a motion in the scene's equations, beside the mean

Vector6d rowOf(const Eigen::Vector3d& lever, const Eigen::Vector3d& normal, double radius) {
  Vector6d row;
  row << lever.cross(normal) / radius, normal;
  return row;
}

}  // namespace

MotionPrior::MotionPrior(const SurfaceSample& surface, double area, const SceneView& scene, double reach, double noise,
                         const Eigen::Isometry3d& T_scene_expected)
    : T_expected_scene_(T_scene_expected.inverse()), pivot_(T_scene_expected * surface.centroid.cast<double>()) {
  double squares = 0;
  for (std::size_t i = 0; i < surface.size; ++i) squares += (surface.point(i) - surface.centroid).squaredNorm();
  if (squares > 0) radius_ = std::sqrt(squares / double(surface.size));
  // Products of the normals of model and scene: noise of the one is not that of the other, and averages out. With
  // those of the scene alone it would look as if all motions were known.
  Matrix6d products = Matrix6d::Zero();
  const Eigen::Isometry3f T = T_scene_expected.cast<float>();
  for (std::size_t i = 0; i < surface.size; ++i) {
    const Eigen::Vector3f point = T * surface.point(i), normal = T.linear() * surface.normal(i);
    if (normal.dot(scene.surface.sensor_origin - point) <= 0) continue;
    const Sighting seen = scene.range_image.look(point, float(reach));
    if (!seen.hasPoint() || !(normal.dot(seen.cell->normal()) > normal_agreement)) continue;
    if ((seen.cell->position() - point).squaredNorm() > float(reach * reach)) continue;
    const Eigen::Vector3d lever = point.cast<double>() - pivot_;
    products += rowOf(lever, normal.cast<double>(), radius_) *
                rowOf(lever, seen.cell->normal().cast<double>(), radius_).transpose();
  }
  products *= 0.5 * std::min(1.0, area / independent_area);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(products + products.transpose());
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
