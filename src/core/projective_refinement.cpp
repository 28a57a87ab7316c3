// SPDX-License-Identifier: BSD-3-Clause
#include "core/projective_refinement.hpp"

#include "core/point_to_plane.hpp"

namespace sks {
namespace {

void findPairs(const TrainingView& view, const SceneView& scene, std::size_t stride, float distance,
               const Eigen::Isometry3d& T_scene_model, std::vector<PointPair>& pairs) {
  const Surface& surface = scene.surface;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  pairs.clear();
  for (std::size_t i = 0; i < view.surface_points.size(); i += stride) {
    const Eigen::Vector3f p = T * view.surface_points[i], n = T.linear() * view.surface_normals[i];
    if (n.dot(surface.sensor_origin - p) <= 0) continue;
    const std::uint32_t partner = scene.range_image.look(p, 0).point;
    if (partner == no_point || !(n.dot(surface.normal(partner)) > normal_agreement)) continue;
    const Eigen::Vector3f q = surface.point(partner);
    if ((p - q).squaredNorm() > distance * distance) continue;
    pairs.push_back({p.cast<double>(), q.cast<double>(), surface.normal(partner).cast<double>()});
  }
}

}  // namespace

Eigen::Isometry3d refineAlongRays(const TrainingView& view, const SceneView& scene, const RefinementSettings& settings,
                                  const Eigen::Isometry3d& T_scene_model) {
  Eigen::Isometry3d refined = T_scene_model;
  const std::size_t stride = view.surface_points.size() / std::size_t(settings.max_points) + 1;
  std::vector<PointPair> pairs;
  for (int i = 0; i < settings.iterations; ++i) {
    const double distance = pairDistance(settings, i);
    findPairs(view, scene, stride, float(distance), refined, pairs);
    if (pairs.size() < fewest_pairs) break;
    refined = pointToPlaneStep(pairs, distance) * refined;
  }
  return refined;
}

}  // namespace sks
