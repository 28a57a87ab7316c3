// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/refinement.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sks {
namespace {

constexpr std::size_t fewest_pairs = 6;   // as many as a rigid motion has degrees of freedom
constexpr float normal_agreement = 0.7f;  // cosine; about 45 degrees

struct Pair {
  Eigen::Vector3d model;  // of the model, mapped into the scene
  Eigen::Vector3d scene;
  Eigen::Vector3d normal;  // of the scene
};

/// Pairs of the model's points that face the sensor with their nearest scene points.
std::vector<Pair> findPairs(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                            const Surface& scene, std::size_t stride, float distance,
                            const Eigen::Isometry3d& T_scene_model, std::vector<PointGrid::Run>& runs) {
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3f p = T * points[i], n = T.linear() * normals[i];
    if (n.dot(scene.sensor_origin - p) <= 0) continue;
    float nearest = std::numeric_limits<float>::infinity();
    std::uint32_t partner = 0;
    scene.forEachNeighbor(p, distance, runs, [&](std::uint32_t j, float squared) {
      if (squared < nearest) {
        nearest = squared;
        partner = j;
      }
    });
    if (!std::isfinite(nearest) || !(n.dot(scene.normal(partner)) > normal_agreement)) continue;
    pairs.push_back({p.cast<double>(), scene.point(partner).cast<double>(), scene.normal(partner).cast<double>()});
  }
  return pairs;
}

/// The small motion that brings the model's points onto the planes of their partners.
Eigen::Isometry3d solveStep(const std::vector<Pair>& pairs, double scale) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // turning about the middle keeps the equations well conditioned
  for (const Pair& pair : pairs) center += pair.model / double(pairs.size());
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 b = Vector6::Zero();
  for (const Pair& pair : pairs) {
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

}  // namespace

Eigen::Isometry3d refinePose(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                             const Surface& scene, const RefinementSettings& settings,
                             const Eigen::Isometry3d& T_scene_model) {
  Eigen::Isometry3d refined = T_scene_model;
  const std::size_t stride = points.size() / std::size_t(settings.max_points) + 1;
  std::vector<PointGrid::Run> runs;
  for (int i = 0; i < settings.iterations; ++i) {
    const double progress = settings.iterations > 1 ? double(i) / (settings.iterations - 1) : 1.0;
    const double distance =
        settings.start_distance * std::pow(settings.end_distance / settings.start_distance, progress);
    const auto pairs = findPairs(points, normals, scene, stride, float(distance), refined, runs);
    if (pairs.size() < fewest_pairs) return i == 0 ? T_scene_model : refined;
    refined = solveStep(pairs, distance) * refined;
  }
  return refined;
}

}  // namespace sks
