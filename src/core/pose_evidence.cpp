// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr float weight_radius = 0.02f;      // [m] the scale of the keypoints' local surfaces
constexpr float grazing = 0.17f;            // cosine; surfaces turned away by more than 80 degrees are hardly measured
constexpr std::size_t glance_points = 80;
constexpr float glance_distance = 0.015f;   // [m] rough poses are that far off
constexpr float glance_agreement = 0.7f;    // cosine, about 45 degrees
constexpr float glance_occlusion = 0.02f;   // [m]
constexpr double unmeasured = 0.5;          // weight of what should be seen where the sensor measured nothing

/// One point of a stored surface in the scene.
struct Placed {
  Eigen::Vector3f point, normal;
};

/// Calls `f(index, placed point)` for every `stride`-th point of the surface that faces the sensor.
template <typename Function>
void forEachFacing(const TrainingView& view, const Surface& scene, const Eigen::Isometry3d& T_scene_model,
                   std::size_t stride, Function&& f) {
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  for (std::size_t i = 0; i < view.surface_points.size(); i += stride) {
    const Placed placed{T * view.surface_points[i], T.linear() * view.surface_normals[i]};
    const Eigen::Vector3f ray = scene.sensor_origin - placed.point;
    if (placed.normal.dot(ray) > grazing * ray.norm()) f(i, placed);
  }
}

/// The scene point within `distance` whose normal agrees best; `no_point` if none does by `agreement`.
std::uint32_t partnerOf(const Placed& placed, const Surface& scene, float distance, float agreement,
                        std::vector<PointGrid::Run>& runs) {
  std::uint32_t partner = no_point;
  scene.forEachNeighbor(placed.point, distance, runs, [&](std::uint32_t j, float) {
    const float cosine = placed.normal.dot(scene.normal(j));
    if (cosine > agreement) {
      agreement = cosine;
      partner = j;
    }
  });
  return partner;
}

}  // namespace

std::vector<float> distinctiveness(const TrainingView& view) {
  const PointGrid grid(view.surface_points, weight_radius);
  std::vector<float> weights(view.surface_points.size(), 0.0f);
  std::vector<PointGrid::Run> runs;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    grid.forEachNeighbor(view.surface_points[i], weight_radius, runs, [&](std::uint32_t j, float) {
      sum += view.surface_normals[grid.source[j]];
      ++count;
    });
    if (count > 0) weights[i] = std::max(0.0f, 1 - sum.norm() / float(count));
  }
  return weights;
}

PoseEvidence examinePose(const TrainingView& view, const std::vector<float>& weights, const SceneView& scene,
                         const Settings& settings, const Eigen::Isometry3d& T_scene_model, std::size_t most_points) {
  const VerificationSettings& verification = settings.verification;
  const std::size_t stride = view.surface_points.size() / most_points + 1;
  const double area = double(stride) * settings.training.surface_resolution * settings.training.surface_resolution;
  const float distance = float(verification.support_distance);
  const float agreement = float(std::cos(verification.support_angle));
  const float object_size = view.extent().maxCoeff();
  PoseEvidence evidence;
  std::vector<PointGrid::Run> runs;
  forEachFacing(view, scene.surface, T_scene_model, stride, [&](std::size_t i, const Placed& placed) {
    const double weighted = area * weights[i];
    evidence.facing += area;
    const std::uint32_t partner = partnerOf(placed, scene.surface, distance, agreement, runs);
    if (partner == no_point) {
      const Sight sight = scene.range_image.look(placed.point, float(verification.occlusion_distance)).sight;
      if (sight == Sight::unknown) evidence.weighted_visible += unmeasured * weighted;
      if (sight == Sight::at || sight == Sight::in_front) evidence.weighted_visible += weighted;
      return;
    }
    if (planeExtentAt(scene.planes, scene.surface.point(partner), scene.surface.normal(partner)) > object_size) return;
    evidence.supported += area;
    evidence.weighted_visible += weighted;
    evidence.weighted_supported += weighted;
    evidence.partners.push_back(partner);
  });
  return evidence;
}

RoughSupport glance(const TrainingView& view, const std::vector<float>& weights, const SceneView& scene,
                    const Eigen::Isometry3d& T_scene_model) {
  const Surface& surface = scene.surface;
  const std::size_t stride = std::max<std::size_t>(1, view.surface_points.size() / glance_points);
  RoughSupport support;
  forEachFacing(view, surface, T_scene_model, stride, [&](std::size_t i, const Placed& placed) {
    const auto [sight, point] = scene.range_image.look(placed.point, glance_occlusion);
    const bool confirmed = point != no_point && placed.normal.dot(surface.normal(point)) > glance_agreement &&
                           (surface.point(point) - placed.point).squaredNorm() < glance_distance * glance_distance;
    if (confirmed) {
      ++support.points;
      support.supported += weights[i];
    }
    if (confirmed || sight == Sight::at || sight == Sight::in_front) {
      support.visible += weights[i];
    } else if (sight == Sight::unknown) {
      support.visible += unmeasured * weights[i];
    }
  });
  return support;
}

}  // namespace sks
