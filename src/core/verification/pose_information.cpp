// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_information.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Eigenvalues>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

constexpr double independent_area = 0.007 * 0.007;  // [m^2] depth errors nearer to each other are alike
constexpr float alike_within = 0.02f;               // [m] errors farther apart are taken for independent
constexpr double common_error = 0.0001;             // [m] of model and sensor that patches share: does not average out
constexpr double sure_above = 3;                    // standard errors of what the pairs tell, which are not counted
constexpr double any_turn = 1.8;                    // [rad] deviation of a turn of which nothing is known

Vector6d rowOf(const Eigen::Vector3d& lever, const Eigen::Vector3d& normal, double radius) {
  Vector6d row;
  row << lever.cross(normal) / radius, normal;
  return row;
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return cross;
}

/// Of a shift of one point and a rotation, the shift of another one, `apart` from it, and the rotation.
Matrix6d atOtherPoint(const Eigen::Vector3d& apart) {
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -crossMatrix(apart);
  return J;
}

Matrix6d rotated(const Matrix6d& covariance, const Eigen::Matrix3d& R) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = R;
  return both * covariance * both.transpose();
}

}  // namespace

double depthNoise(double range) {
  return 0.0012 + 0.0019 * (range - 0.4) * (range - 0.4);
}

PoseInformation::PoseInformation(const SurfaceSample& surface, double area, const SceneView& scene, double reach,
                                 const Eigen::Isometry3d& T_scene_model)
    : pivot(T_scene_model * surface.centroid.cast<double>()) {
  double squares = 0;
  for (std::size_t i = 0; i < surface.size; ++i) squares += (surface.point(i) - surface.centroid).squaredNorm();
  if (squares > 0) radius = std::sqrt(squares / double(surface.size));
  // Products of the normals of model and scene: noise of the one is not that of the other, and averages out. With
  // those of the scene alone it would look as if all motions were known.
  Matrix6d products = Matrix6d::Zero();
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  for (std::size_t i = 0; i < surface.size; ++i) {
    const Eigen::Vector3f point = T * surface.point(i), normal = T.linear() * surface.normal(i);
    if (normal.dot(scene.surface.sensor_origin - point) <= 0) continue;
    const Sighting seen = scene.range_image.look(point, float(reach));
    if (!seen.hasPoint() || !(normal.dot(seen.cell->normal()) > normal_agreement)) continue;
    if ((seen.cell->position() - point).squaredNorm() > float(reach * reach)) continue;
    const Eigen::Vector3d lever = point.cast<double>() - pivot;
    pairs_.push_back({rowOf(lever, normal.cast<double>(), radius),
                      rowOf(lever, seen.cell->normal().cast<double>(), radius), surface.point(i),
                      double(normal.dot(seen.cell->position() - point))});
    products += pairs_.back().of_model * pairs_.back().of_scene.transpose();
  }
  patches_ = std::min(1.0, area / independent_area);
  products *= 0.5 * patches_;
  matrix = products + products.transpose();
}

Vector6d PoseInformation::standardErrors(const Matrix6d& axes) const {
  Vector6d squares = Vector6d::Zero();
  for (const Pair& pair : pairs_) {
    const Vector6d a = axes.transpose() * pair.of_model, b = axes.transpose() * pair.of_scene;
    squares += patches_ * a.cwiseProduct(b).cwiseAbs2();
  }
  return squares.cwiseSqrt();
}

double PoseInformation::depthVariance() const {
  std::map<std::array<int, 3>, Vector6d> pulls;
  double alone = 0;
  for (const Pair& pair : pairs_) {
    const Eigen::Array3i cube = (pair.place / alike_within).array().floor().cast<int>();
    pulls.try_emplace({cube[0], cube[1], cube[2]}, Vector6d::Zero()).first->second += pair.distance * pair.of_model;
    alone += pair.of_model.dot(pair.of_scene);
  }
  double together = 0;
  for (const auto& [cube, pull] : pulls) together += pull.squaredNorm();
  // The pose was fitted to the same distances, which takes six of them.
  const double count = std::max(7.0, double(pulls.size()));
  const double variance = alone > 0 ? together / alone * count / (count - 6) : 0;
  return std::max(patches_ * variance, common_error * common_error);
}

Matrix6d poseCovariance(const PoseInformation& information, const Eigen::Isometry3d& T_scene_model,
                        const Eigen::Vector3d& center, double size) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(information.matrix);
  const Vector6d doubt = information.standardErrors(solver.eigenvectors());
  const Vector6d sure = (solver.eigenvalues() - sure_above * doubt).cwiseMax(0);
  const Matrix6d known =
      solver.eigenvectors() * sure.asDiagonal() * solver.eigenvectors().transpose() / information.depthVariance();
  Vector6d possible;
  possible << Eigen::Vector3d::Constant(any_turn * information.radius), Eigen::Vector3d::Constant(size);
  const Matrix6d covariance = (known + Matrix6d(possible.cwiseAbs2().cwiseInverse().asDiagonal())).inverse() +
                              common_error * common_error * Matrix6d::Identity();
  Matrix6d shift_first = Matrix6d::Zero();
  shift_first.topRightCorner<3, 3>().setIdentity();
  shift_first.bottomLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / information.radius;
  const Matrix6d J = atOtherPoint(T_scene_model * center - information.pivot) * shift_first;
  return rotated(J * covariance * J.transpose(), T_scene_model.linear().transpose());
}

Matrix6d covarianceInScene(const Matrix6d& in_model, const Eigen::Isometry3d& T_scene_model,
                           const Eigen::Vector3d& center) {
  const Matrix6d J = atOtherPoint(-center);
  return rotated(J * in_model * J.transpose(), T_scene_model.linear());
}

Matrix6d covarianceInModel(const Matrix6d& in_scene, const Eigen::Isometry3d& T_scene_model,
                           const Eigen::Vector3d& center) {
  const Matrix6d J = atOtherPoint(center);
  return J * rotated(in_scene, T_scene_model.linear().transpose()) * J.transpose();
}

}  // namespace sks
