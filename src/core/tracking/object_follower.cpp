// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/object_follower.hpp"

#include <algorithm>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/pipeline/scene_description.hpp"
#include "core/tracking/object_crop.hpp"
#include "core/verification/pose_information.hpp"
#include "core/verification/projective_refinement.hpp"
#include "core/verification/refinement.hpp"
#include "core/verification/standing_things.hpp"
#include "core/verification/surface_sample.hpp"

namespace sks {
namespace {

constexpr double margin = 0.03;             // [m] around the box: what the outline and the plane below need
constexpr double quick_points = 3;          // spacings of the points of a quick look within the radius of a normal
constexpr float flat_object = 0.03f;        // [m] what is thinner may lie within the tolerance of the plane below it
constexpr double fewest_in_crop = 50;       // of a crop: else nothing can be said
constexpr std::size_t glance_points = 500;  // of a view, by which a quick look tells whether the object is there
constexpr int fine_points = 8;              // times as many points, of all sides, fit the pose in the last rounds
constexpr int last_rounds = 3;              // of ICP

Settings oneThread(Settings settings) {
  settings.threads = 1;
  return settings;
}

}  // namespace

ObjectFollower::ObjectFollower(std::shared_ptr<const VerifiedModels> models, const Settings& settings)
    : models_(std::move(models)), settings_(oneThread(settings)), no_votes_(models_->codebook->objects.size()) {}

FollowedObject ObjectFollower::follow(const Cloud& cloud, const Hypothesis& expected,
                                      const std::vector<Eigen::Isometry3d>& starts, const Eigen::Vector3f& color_shift,
                                      Look look) const {
  const Codebook& codebook = *models_->codebook;
  const TrainingView& view = codebook.views[expected.view];
  FollowedObject followed{expected, 0, 0, {}};
  followed.hypothesis.evidence = 0;
  followed.hypothesis.T_scene_model = starts.front();
  const Eigen::Isometry3d T_cloud_box = starts.front() * Eigen::Translation3d(view.center().cast<double>());
  const Eigen::Vector3d half = 0.5 * view.extent().cast<double>() + Eigen::Vector3d::Constant(margin);
  const double spacing = look == Look::quick ? settings_.surface.normal_radius / quick_points : 0;
  const ObjectCrop crop = cropAround(cloud, T_cloud_box, half, spacing);
  if (double(crop.cloud.size()) < fewest_in_crop) return followed;
  Surface surface;
  try {
    const Cloud usable = usableCloud(crop.cloud, Orientation::sensor, codebook, settings_);
    surface = look == Look::full ? prepareScene(usable, settings_.surface, 1)
                                 : prepareSurface(usable, settings_.surface, Orientation::sensor, 1);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_data) throw;
    return followed;  // the sensor measured nothing there
  }
  // Only what is flat can be taken for a part of the plane that it lies on, or the other way around.
  const bool flat = view.extent().minCoeff() < flat_object;
  SceneView scene(surface, flat || look == Look::full ? findLargePlanes(surface) : std::vector<LargePlane>(),
                  settings_);
  scene.color_shift = color_shift;
  if (flat) scene.rises = findStandingThings(surface, scene.planes, view.extent().norm()).rises;

  const PoseExaminer examiner(*models_, scene, no_votes_, settings_);
  Examined best;
  for (const Eigen::Isometry3d& start : starts) {
    Hypothesis hypothesis = expected;
    hypothesis.view = nearestView(*models_->surfaces[expected.view], surface.sensor_origin, start);
    hypothesis.T_scene_model = fitted(hypothesis, scene, start);
    Examined examined{std::move(hypothesis), {}, {}};
    if (starts.size() > 1) examined = examiner.examineAlongRays(std::move(examined.hypothesis));
    if (&start == &starts.front() || examined.hypothesis.evidence > best.hypothesis.evidence)
      best = std::move(examined);
  }
  PoseEvidence pose;
  if (look == Look::full) {
    best = examiner.examine(std::move(best.hypothesis), &pose);
    followed.color_shift = best.lines.color_shift;
    best.hypothesis.covariance = examiner.covarianceOf(best.hypothesis);
  } else {
    const TrainingView& nearest = codebook.views[best.hypothesis.view];
    pose = examinePose(nearest, models_->weights.at(best.hypothesis.view, strideFor(nearest, glance_points)), scene,
                       settings_, best.hypothesis.T_scene_model, glance_points, CorrespondenceSearch::nearby);
  }
  if (pose.facing > 0) followed.hidden = pose.occluded / pose.facing;
  if (pose.weighted_visible > 0) followed.confirmed = pose.weighted_supported / pose.weighted_visible;
  followed.hypothesis = std::move(best.hypothesis);
  followed.hypothesis.T_scene_box =
      followed.hypothesis.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
  return followed;
}

Eigen::Isometry3d ObjectFollower::fitted(const Hypothesis& expected, const SceneView& scene,
                                         const Eigen::Isometry3d& start) const {
  thread_local SurfaceSample few;  // keeps its buffers from cloud to cloud
  const TrainingView& view = models_->codebook->views[expected.view];
  const ModelSurface& surface = *models_->surfaces[expected.view];
  const RefinementSettings& rough = settings_.refinement;
  const std::size_t stride = strideFor(view, std::size_t(rough.max_points));
  few.take(view, stride);
  const double resolution = settings_.training.surface_resolution;
  const Eigen::Vector3d center = start * view.center().cast<double>();
  const double noise = depthNoise((center - scene.surface.sensor_origin.cast<double>()).norm());
  const MotionPrior prior(few, double(stride) * resolution * resolution, scene, rough.start_distance, noise, start);
  const Eigen::Isometry3d near = refineAlongRays(few, scene, rough, rough.iterations, start, &prior);
  RefinementSettings last = rough;
  last.start_distance = last.end_distance;
  last.iterations = last_rounds;
  last.max_points *= fine_points;
  return refinePose(surface.points, surface.normals, scene.surface, last, near, &prior);
}

}  // namespace sks
