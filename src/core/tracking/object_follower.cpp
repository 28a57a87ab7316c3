// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/object_follower.hpp"

#include <algorithm>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/pipeline/scene_description.hpp"
#include "core/tracking/object_crop.hpp"
#include "core/verification/projective_refinement.hpp"
#include "core/verification/standing_things.hpp"

namespace sks {
namespace {

constexpr double margin = 0.03;        // [m] around the box: what the outline and the plane below need
constexpr double quick_points = 3;     // spacings of the points of a quick look within the radius of a normal
constexpr float flat_object = 0.03f;   // [m] what is thinner may lie within the tolerance of the plane below it
constexpr double fewest_in_crop = 50;  // of a crop: else nothing can be said

Settings oneThread(Settings settings) {
  settings.threads = 1;
  return settings;
}

}  // namespace

double depthNoise(double range) {
  return 0.0012 + 0.0019 * (range - 0.4) * (range - 0.4);
}

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
    surface = prepareSurface(usableCloud(crop.cloud, Orientation::sensor, codebook, settings_), settings_.surface,
                             Orientation::sensor, 1);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_data) throw;
    return followed;  // the sensor measured nothing there
  }
  SceneView scene(surface, settings_, 1);
  scene.color_shift = color_shift;
  const float largest = view.extent().norm();
  if (view.extent().minCoeff() < flat_object) scene.rises = findStandingThings(surface, scene.planes, largest).rises;

  const PoseExaminer examiner(*models_, scene, no_votes_, settings_);
  Examined best;
  for (const Eigen::Isometry3d& start : starts) {
    Hypothesis hypothesis = expected;
    hypothesis.view = nearestView(*models_->surfaces[expected.view], surface.sensor_origin, start);
    hypothesis.T_scene_model = refineAlongRays(codebook.views[hypothesis.view], scene, settings_.refinement, start);
    Examined examined = examiner.examineAlongRays(std::move(hypothesis));
    if (&start == &starts.front() || examined.hypothesis.evidence > best.hypothesis.evidence)
      best = std::move(examined);
  }
  PoseEvidence pose;
  best = examiner.examine(examiner.refined(std::move(best.hypothesis)), &pose);
  if (pose.facing > 0) followed.hidden = pose.occluded / pose.facing;
  if (pose.weighted_visible > 0) followed.confirmed = pose.weighted_supported / pose.weighted_visible;
  followed.color_shift = best.lines.color_shift;
  followed.hypothesis = examiner.finished(best.hypothesis);
  return followed;
}

}  // namespace sks
