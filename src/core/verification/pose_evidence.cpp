// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/verification/color_agreement.hpp"

namespace sks {
namespace {

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

/// The scene point that confirms a point of a stored surface, and by how much.
struct Correspondence {
  std::uint32_t point = no_point;
  float agreement = 1;  // of the colours
};

/// The scene point within `distance` that the sensor saw in this direction, or else the one whose normal agrees best;
/// `no_point` if none does by `agreement`. Prints shift by some pixels where a pose is a little off: of all such
/// points, the one of the most similar colour counts.
Correspondence correspondenceOf(const Placed& placed, const Sighting& seen, const Eigen::Vector3f* color,
                                const SceneView& scene, float distance, float agreement, CorrespondenceSearch search,
                                std::vector<PointGrid::Run>& runs) {
  const Surface& surface = scene.surface;
  Correspondence correspondence;
  const bool seen_there = seen.hasPoint() && placed.normal.dot(seen.cell->normal()) > agreement &&
                          (seen.cell->position() - placed.point).squaredNorm() <= distance * distance;
  if (seen_there && (color == nullptr || search == CorrespondenceSearch::along_ray)) {
    correspondence.point = scene.range_image.pointOf(seen);
    if (color != nullptr) {
      const float difference = squaredColorDifference(*color, scene.colorAt(correspondence.point));
      correspondence.agreement = colorAgreement(difference, scene.color_tolerance);
    }
    return correspondence;
  }
  if (search == CorrespondenceSearch::along_ray) return correspondence;
  float best = agreement, difference = std::numeric_limits<float>::infinity();
  surface.forEachNeighbor(placed.point, distance, runs, [&](std::uint32_t j, float) {
    const float cosine = placed.normal.dot(surface.normal(j));
    if (color != nullptr && cosine > agreement) {
      difference = std::min(difference, squaredColorDifference(*color, scene.colorAt(j)));
    }
    if (cosine > best) {
      best = cosine;
      correspondence.point = j;
    }
  });
  if (color != nullptr) correspondence.agreement = colorAgreement(difference, scene.color_tolerance);
  return correspondence;
}

}  // namespace

SceneView::SceneView(const Surface& scene, const Settings& settings, int threads)
    : SceneView(scene, findLargePlanes(scene, threads), settings, threads) {}

SceneView::SceneView(const Surface& scene, std::vector<LargePlane> large_planes, const Settings& settings, int threads)
    : surface(scene),
      range_image(scene, float(settings.surface.normal_radius), threads),
      planes(std::move(large_planes)),
      color_tolerance(scene.hasColor() ? float(settings.verification.color_tolerance) : 0),
      rises(scene.size(), 0) {}

PoseEvidence examinePose(const TrainingView& view, const SurfaceWeights& surface_weights, const SceneView& scene,
                         const Settings& settings, const Eigen::Isometry3d& T_scene_model, std::size_t most_points,
                         CorrespondenceSearch search) {
  const VerificationSettings& verification = settings.verification;
  const std::size_t stride = strideFor(view, most_points);
  const double area = double(stride) * settings.training.surface_resolution * settings.training.surface_resolution;
  const float distance = float(verification.support_distance);
  const float agreement = float(std::cos(verification.support_angle));
  const float object_size = view.extent().maxCoeff();
  const bool compares_color = scene.comparesColor(view);
  const std::vector<float>& weights = compares_color ? surface_weights.shape_and_color : surface_weights.shape;
  PoseEvidence evidence;
  evidence.confirming.reserve(view.surface_points.size() / stride + 1);
  thread_local std::vector<PointGrid::Run> runs;  // kept from pose to pose
  forEachFacing(view, scene.surface, T_scene_model, stride, [&](std::size_t i, const Placed& placed) {
    const double weighted = area * weights[i];
    evidence.facing += area;
    const Eigen::Vector3f* color = compares_color ? &view.surface_colors[i] : nullptr;
    const Sighting seen = scene.range_image.look(placed.point, float(verification.occlusion_distance));
    const Correspondence correspondence =
        correspondenceOf(placed, seen, color, scene, distance, agreement, search, runs);
    if (correspondence.point == no_point) {
      if (seen.sight == Sight::occluded) evidence.occluded += area;
      if (seen.sight == Sight::unknown) evidence.weighted_visible += unmeasured * weighted;
      if (seen.sight == Sight::at || seen.sight == Sight::in_front) evidence.weighted_visible += weighted;
      return;
    }
    if (scene.onLargerPlane(correspondence.point, object_size)) return;
    evidence.supported += area * correspondence.agreement;
    evidence.weighted_visible += weighted;
    evidence.weighted_supported += weighted * correspondence.agreement;
    evidence.confirming.push_back(correspondence.point);
  });
  return evidence;
}

}  // namespace sks
