// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/refinement.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "core/verification/point_to_plane.hpp"

namespace sks {
namespace {

/// A point of the model, mapped into the scene, with its corresponding point there.
struct PointPair {
  Eigen::Vector3d model, scene, normal;
};

/// Pairs of the model's points that face the sensor with their nearest scene points.
void findPairs(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
               const Surface& scene, std::size_t stride, float distance, const Eigen::Isometry3d& T_scene_model,
               std::vector<PointGrid::Run>& runs, std::vector<PointPair>& pairs) {
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  pairs.clear();
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3f p = T * points[i], n = T.linear() * normals[i];
    if (n.dot(scene.sensor_origin - p) <= 0) continue;
    float nearest = std::numeric_limits<float>::infinity();
    std::uint32_t nearest_point = 0;
    scene.forEachNeighbor(p, distance, runs, [&](std::uint32_t j, float squared) {
      if (squared < nearest) {
        nearest = squared;
        nearest_point = j;
      }
    });
    if (!std::isfinite(nearest) || !(n.dot(scene.normal(nearest_point)) > normal_agreement)) continue;
    pairs.push_back(
        {p.cast<double>(), scene.point(nearest_point).cast<double>(), scene.normal(nearest_point).cast<double>()});
  }
}

}  // namespace

Eigen::Isometry3d refinePose(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                             const Surface& scene, const RefinementSettings& settings,
                             const Eigen::Isometry3d& T_scene_model, const MotionPrior* prior) {
  Eigen::Isometry3d refined = T_scene_model;
  const std::size_t stride = points.size() / std::size_t(settings.max_points) + 1;
  thread_local std::vector<PointGrid::Run> runs;  // kept from pose to pose
  thread_local std::vector<PointPair> pairs;
  for (int i = 0; i < settings.iterations; ++i) {
    const double distance = pairDistance(settings, i);
    findPairs(points, normals, scene, stride, float(distance), refined, runs, pairs);
    if (pairs.size() < fewest_pairs) return i == 0 ? T_scene_model : refined;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const PointPair& pair : pairs) center += pair.model / double(pairs.size());
    PointToPlane system(center);
    for (const PointPair& pair : pairs) system.add(pair.model, pair.scene, pair.normal, distance);
    if (prior != nullptr) system.hold(*prior, refined);
    refined = system.motion() * refined;
  }
  return refined;
}

void refine(Hypothesis& hypothesis, const Codebook& codebook, const Surface& scene,
            const RefinementSettings& settings) {
  const TrainingView& view = codebook.views[hypothesis.view];
  const Eigen::Isometry3d T_model_box = hypothesis.T_scene_model.inverse() * hypothesis.T_scene_box;
  hypothesis.T_scene_model =
      refinePose(view.surface_points, view.surface_normals, scene, settings, hypothesis.T_scene_model);
  hypothesis.T_scene_box = hypothesis.T_scene_model * T_model_box;
}

void refineHypotheses(std::vector<Hypothesis>& hypotheses, const Codebook& codebook, const Surface& scene,
                      const RefinementSettings& settings, int threads) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    if (hypotheses[i].density >= settings.min_density) refine(hypotheses[i], codebook, scene, settings);
  }
}

}  // namespace sks
