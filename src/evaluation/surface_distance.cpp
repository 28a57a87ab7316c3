// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sks {
namespace {

constexpr double farthest_away = std::numeric_limits<double>::infinity();

/// Smallest over the symmetries of the greatest distance over the points.
/// @param distance squared, of a point of the model by its number and its true position in the scene
template <typename Distance>
double smallestGreatest(const ObjectModel& model, const Eigen::Isometry3d& T_scene_true, Distance distance) {
  double smallest = farthest_away;
  std::size_t worst = 0;  // of the last symmetry: the first to look at rules most of the others out
  for (const Eigen::Isometry3d& symmetry : model.symmetries) {
    const Eigen::Isometry3d T_scene_same = T_scene_true * symmetry;
    double greatest = distance(worst, T_scene_same * model.points[worst]);
    for (std::size_t i = 0; i < model.points.size() && greatest < smallest; ++i) {
      const double d = distance(i, T_scene_same * model.points[i]);
      if (d <= greatest) continue;
      greatest = d;
      worst = i;
    }
    smallest = std::min(smallest, greatest);
  }
  return std::sqrt(smallest);
}

Eigen::Vector2d pictureOf(const SceneCamera& camera, const Eigen::Vector3d& p) {
  return {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
}

}  // namespace

double surfaceDistance(const ObjectModel& model, const Eigen::Isometry3d& T_scene_found,
                       const Eigen::Isometry3d& T_scene_true) {
  return smallestGreatest(model, T_scene_true, [&](std::size_t i, const Eigen::Vector3d& p) {
    return (T_scene_found * model.points[i] - p).squaredNorm();
  });
}

double projectionDistance(const ObjectModel& model, const SceneCamera& camera, const Eigen::Isometry3d& T_scene_found,
                          const Eigen::Isometry3d& T_scene_true) {
  std::vector<Eigen::Vector2d> found;
  for (const Eigen::Vector3d& point : model.points) {
    const Eigen::Vector3d p = T_scene_found * point;
    if (p.z() <= 0) return farthest_away;
    found.push_back(pictureOf(camera, p));
  }
  return smallestGreatest(model, T_scene_true, [&](std::size_t i, const Eigen::Vector3d& p) {
    return p.z() > 0 ? (found[i] - pictureOf(camera, p)).squaredNorm() : farthest_away;
  });
}

}  // namespace sks
