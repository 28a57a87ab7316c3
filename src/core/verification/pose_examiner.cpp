// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_examiner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/surface/angular_spacing.hpp"
#include "core/verification/pose_information.hpp"
#include "core/verification/refinement.hpp"
#include "core/verification/turned_poses.hpp"

namespace sks {
namespace {

constexpr double area_unit = 1e-4;      // [m^2] areas enter the evidence in cm^2
constexpr double prior_area = 0.25e-4;  // [m^2] keeps the fraction of a very small area low
constexpr double color_gain = 1.8;      // of evidence: what right poses lose by colours that agree to about 0.8
constexpr std::size_t first_points = 250, last_points = 1500;  // examined to choose between poses, and of the chosen
constexpr double least_promising = 0.5;  // evidence of a turned pose before its fit, beside that of the pose itself
constexpr std::size_t most_fitted = 6;   // of turned poses, by how they agree before the fit
constexpr double standing_density = 2;   // of votes: what it is worth that something stands alone there

constexpr double finest_step = 1.5 * EIGEN_PI / 180;  // [rad] of turns about the axis of a body: 1 mm of a mug

constexpr int fine = 8;  // times as many points, of all sides, fit the pose that is told in the end

/// Of ICP with nearest pairs, for poses that are a fraction of a millimetre off.
RefinementSettings lastRounds(RefinementSettings settings) {
  settings.iterations = (settings.iterations + 1) / 2;
  settings.start_distance = settings.end_distance;
  return settings;
}

/// The fraction of the visible surface that is confirmed.
double fractionOf(const PoseEvidence& pose) {
  return pose.weighted_supported / (pose.weighted_visible + prior_area);
}

/// The fraction of all that faces the sensor that is confirmed.
double coverageOf(const PoseEvidence& pose) {
  return pose.supported / (pose.facing + prior_area);
}

}  // namespace

VerifiedModels::VerifiedModels(std::shared_ptr<const Codebook> models, int threads)
    : codebook(std::move(models)), surfaces(modelSurfaces(*codebook, threads)), weights(codebook->views, first_points) {
  const std::vector<TrainingView>& views = codebook->views;
  rough.resize(views.size());
  std::vector<std::vector<RestingPose>> rests(views.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t v = 0; v < views.size(); ++v) {
    rough[v] = RoughSurface(views[v]);
    const std::vector<std::uint32_t>& together = surfaces[v]->views;
    if (together.size() > 1 && together.front() == v) rests[v] = restingPoses(*surfaces[v]);
  }
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const RestingPose& rest : rests[v]) resting.push_back({views[v].object, surfaces[v].get(), rest});
  }
}

float VerifiedModels::stickWidth() const {
  float thinnest = 0;
  for (const RestingModel& model : resting) {
    const float width = std::max(model.rest.base.width, model.rest.height);
    if (model.rest.isStick() && (thinnest == 0 || width < thinnest)) thinnest = width;
  }
  return thinnest;
}

std::uint32_t nearestView(const ModelSurface& surface, const Eigen::Vector3f& sensor_origin,
                          const Eigen::Isometry3d& T_scene_model) {
  const Eigen::Vector3f sensor = (T_scene_model.inverse() * sensor_origin.cast<double>()).cast<float>();
  std::size_t nearest = 0;
  float highest = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < surface.views.size(); ++i) {
    const Eigen::Vector3f ray = sensor - surface.centers[i];
    const float along = surface.directions[i].dot(ray), squared = ray.squaredNorm();
    if (!(squared > 0)) continue;
    const float cosine = along * std::abs(along) / squared;  // its square, with its sign: without a root
    if (cosine <= highest) continue;
    highest = cosine;
    nearest = i;
  }
  return surface.views[nearest];
}

PoseExaminer::PoseExaminer(const VerifiedModels& models, const SceneView& scene,
                           const std::vector<std::vector<Vote>>& spaces, const Settings& settings)
    : models_(models), codebook_(*models.codebook), scene_(scene), settings_(settings) {
  densities_.resize(spaces.size());
  for (std::size_t object = 0; object < spaces.size(); ++object) {
    if (!spaces[object].empty()) densities_[object].emplace(spaces[object], settings.voting.bandwidth);
  }
}

double PoseExaminer::roughEvidence(std::uint32_t object, std::uint32_t view, bool stands,
                                   const Eigen::Isometry3d& T_scene_model, const RoughSupport& support) const {
  const Eigen::Vector3f center = (T_scene_model * codebook_.views[view].center().cast<double>()).cast<float>();
  const double resolution = settings_.training.surface_resolution;
  const double area = double(models_.rough[view].stride) * resolution * resolution;
  PoseEvidence pose;
  pose.facing = area * support.facing;
  pose.supported = area * support.agreement;
  pose.weighted_visible = area * support.visible;
  pose.weighted_supported = area * support.supported;
  return evidenceOf(pose, view, stands, center, densities_[object] ? densities_[object]->at(center) : 0);
}

Examined PoseExaminer::examineAlongRays(Hypothesis hypothesis) const {
  const VerificationSettings& verification = settings_.verification;
  RoughLimits limits;
  limits.distance = float(verification.support_distance);
  limits.agreement = float(std::cos(verification.support_angle));
  limits.occlusion = float(verification.occlusion_distance);
  limits.color_slack = 1;
  limits.passes_planes = true;
  place(hypothesis);
  const RoughSupport support = roughSupport(models_.rough[hypothesis.view], scene_, hypothesis.T_scene_model, limits);
  hypothesis.evidence =
      roughEvidence(hypothesis.object, hypothesis.view, hypothesis.stands, hypothesis.T_scene_model, support);
  return {std::move(hypothesis), {}, {}};
}

Examined PoseExaminer::examineRoughly(Hypothesis hypothesis) const {
  PoseEvidence pose;
  hypothesis.evidence = evidenceAt(hypothesis, pose, first_points, CorrespondenceSearch::nearby);
  SightLines lines = sightLines(hypothesis);
  hypothesis.evidence *= lines.agreement();
  return {std::move(hypothesis), std::move(pose.confirming), std::move(lines)};
}

Examined PoseExaminer::examine(Hypothesis hypothesis, PoseEvidence* areas) const {
  PoseEvidence pose;
  hypothesis.evidence = evidenceAt(hypothesis, pose, last_points, CorrespondenceSearch::nearby);
  SightLines lines = sightLines(hypothesis);
  hypothesis.evidence *= lines.agreement() * lines.pattern;
  if (areas != nullptr) {
    *areas = std::move(pose);
    return {std::move(hypothesis), areas->confirming, std::move(lines)};
  }
  return {std::move(hypothesis), std::move(pose.confirming), std::move(lines)};
}

Hypothesis PoseExaminer::refined(Hypothesis hypothesis) const {
  const TrainingView& view = codebook_.views[hypothesis.view];
  hypothesis.T_scene_model = refinePose(view.surface_points, view.surface_normals, scene_.surface,
                                        lastRounds(settings_.refinement), hypothesis.T_scene_model);
  return hypothesis;
}

Hypothesis PoseExaminer::fitted(Hypothesis hypothesis) const {
  const ModelSurface& surface = *models_.surfaces[hypothesis.view];
  RefinementSettings refinement = lastRounds(settings_.refinement);
  refinement.max_points *= fine;
  hypothesis.T_scene_model =
      refinePose(surface.points, surface.normals, scene_.surface, refinement, hypothesis.T_scene_model);
  return hypothesis;
}

template <typename Fit>
Hypothesis PoseExaminer::bestOfTurned(const Hypothesis& hypothesis, Fit&& fit) const {
  const auto glance = [&](Hypothesis h) {
    PoseEvidence pose;
    return evidenceAt(h, pose, first_points, CorrespondenceSearch::along_ray);
  };
  std::vector<Hypothesis> poses{hypothesis};
  const double least = least_promising * glance(hypothesis);
  for (Hypothesis& turned : turnedAround(hypothesis)) {
    if (glance(turned) >= least) poses.push_back(std::move(turned));  // else another side, whatever a fit would gain
  }
  PoseComparison comparison = comparisonFor(hypothesis);
  for (const Hypothesis& pose : poses) comparison.add(pose.T_scene_model, shapeFactor(pose));
  for (const std::size_t i : comparison.ranked(most_fitted)) {
    if (i == 0) continue;
    Hypothesis fitted = fit(poses[i]);
    comparison.add(fitted.T_scene_model, shapeFactor(fitted));
    poses.push_back(std::move(fitted));
  }
  const std::size_t number = comparison.ranked(1).front();
  Hypothesis best = std::move(poses[number]);
  const std::optional<BodyAxis>& body = models_.surfaces[best.view]->body;
  if (!body) return best;
  turnFinely(best, number, *body, comparison);
  return withBetterTurn(best, fit(best));
}

double PoseExaminer::shapeFactor(const Hypothesis& hypothesis) const {
  const TrainingView& view = codebook_.views[hypothesis.view];
  if (scene_.comparesColor(view)) return 1;
  const PoseEvidence pose =
      examinePose(view, models_.weights.at(hypothesis.view, strideFor(view, last_points)), scene_, settings_,
                  hypothesis.T_scene_model, last_points, CorrespondenceSearch::along_ray);
  return fractionOf(pose) * std::sqrt(coverageOf(pose)) * sightLines(hypothesis).agreement();
}

PoseComparison PoseExaminer::comparisonFor(const Hypothesis& hypothesis) const {
  return {*models_.surfaces[hypothesis.view], scene_, settings_.verification, hypothesis.box_size.maxCoeff()};
}

void PoseExaminer::turnFinely(Hypothesis& hypothesis, std::size_t number, const BodyAxis& body,
                              PoseComparison& comparison) const {
  for (double step = body_step / 2; step > finest_step; step /= 2) {
    for (const double angle : {-step, step}) {
      const Eigen::Isometry3d turned = turnedAbout(body, angle, hypothesis.T_scene_model);
      Hypothesis candidate = hypothesis;
      candidate.T_scene_model = turned;
      const std::size_t i = comparison.add(turned, shapeFactor(candidate));
      if (comparison.agreement(i) <= comparison.agreement(number)) continue;
      number = i;
      hypothesis.T_scene_model = turned;
      break;
    }
  }
}

Hypothesis PoseExaminer::withBetterTurn(const Hypothesis& before, Hypothesis fitted) const {
  const std::optional<BodyAxis>& body = models_.surfaces[fitted.view]->body;
  if (!body) return fitted;
  Hypothesis kept = fitted;
  const double back = turnAbout(*body, fitted.T_scene_model, before.T_scene_model);
  kept.T_scene_model = turnedAbout(*body, back, fitted.T_scene_model);
  PoseComparison comparison = comparisonFor(fitted);
  comparison.add(fitted.T_scene_model, shapeFactor(fitted));
  comparison.add(kept.T_scene_model, shapeFactor(kept));
  return comparison.ranked(1).front() == 0 ? fitted : kept;
}

Hypothesis PoseExaminer::bestTurned(const Hypothesis& hypothesis) const {
  const TrainingView& view = codebook_.views[hypothesis.view];
  if (!scene_.comparesColor(view) || models_.surfaces[hypothesis.view]->views.size() < 2) return hypothesis;
  return bestOfTurned(hypothesis, [&](Hypothesis h) { return refined(std::move(h)); });
}

std::vector<Hypothesis> PoseExaminer::turnedAround(const Hypothesis& hypothesis) const {
  std::vector<Hypothesis> all;
  const Eigen::Vector3d center = codebook_.views[hypothesis.view].center().cast<double>();
  const std::optional<BodyAxis>& body = models_.surfaces[hypothesis.view]->body;
  for (const auto& T : turnedPoses(hypothesis.T_scene_model, center, hypothesis.box_size, body)) {
    Hypothesis turned = hypothesis;
    turned.T_scene_model = T;
    turned.view = nearestView(*models_.surfaces[turned.view], scene_.surface.sensor_origin, T);
    all.push_back(std::move(turned));
  }
  return all;
}

Hypothesis PoseExaminer::finished(const Hypothesis& hypothesis) const {
  Hypothesis best = bestFitted(hypothesis);
  const TrainingView& view = codebook_.views[best.view];
  best.T_scene_box = best.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
  best.box_size = view.extent().cast<double>();
  best.covariance = covarianceOf(best);
  return best;
}

Matrix6d PoseExaminer::covarianceOf(const Hypothesis& hypothesis) const {
  thread_local SurfaceSample sample;  // keeps its buffers from pose to pose
  const TrainingView& view = codebook_.views[hypothesis.view];
  const std::size_t stride = strideFor(view, last_points);
  sample.take(view, stride);
  const double resolution = settings_.training.surface_resolution;
  const PoseInformation information(sample, double(stride) * resolution * resolution, scene_,
                                    settings_.refinement.end_distance, hypothesis.T_scene_model);
  return poseCovariance(information, hypothesis.T_scene_model, view.center().cast<double>(),
                        double(view.extent().maxCoeff()));
}

Hypothesis PoseExaminer::bestFitted(const Hypothesis& hypothesis) const {
  const TrainingView& view = codebook_.views[hypothesis.view];
  const bool registered = models_.surfaces[hypothesis.view]->views.size() > 1;
  if (!registered && view.kind != ViewKind::model) return hypothesis;  // a single view gets no more exact
  const Hypothesis best = withBetterTurn(hypothesis, fitted(hypothesis));
  if (!registered || scene_.comparesColor(view)) return best;
  // By its shape alone a box hardly differs from the box turned around.
  return bestOfTurned(best, [&](Hypothesis h) { return fitted(std::move(h)); });
}

double PoseExaminer::evidenceAt(Hypothesis& hypothesis, PoseEvidence& pose, std::size_t most_points,
                                CorrespondenceSearch search) const {
  const TrainingView& view = codebook_.views[hypothesis.view];
  place(hypothesis);
  pose = examinePose(view, models_.weights.at(hypothesis.view, strideFor(view, most_points)), scene_, settings_,
                     hypothesis.T_scene_model, most_points, search);
  const Eigen::Vector3f center = hypothesis.T_scene_box.translation().cast<float>();
  // Of fewer points beside one of the model the best agrees less well; measured with every second and third row.
  const double thinned = std::sqrt(double(scene_.surface.step));
  return thinned * evidenceOf(pose, hypothesis.view, hypothesis.stands, center, hypothesis.density);
}

/// The object's box in the pose, and the votes for its centre.
void PoseExaminer::place(Hypothesis& hypothesis) const {
  const TrainingView& view = codebook_.views[hypothesis.view];
  hypothesis.T_scene_box = hypothesis.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
  hypothesis.box_size = view.extent().cast<double>();
  const Eigen::Vector3f center = hypothesis.T_scene_box.translation().cast<float>();
  if (const auto& density = densities_[hypothesis.object]) {
    hypothesis.density = density->at(center);
    hypothesis.votes = density->count(center);
  }
}

/// The evidence grows with the fraction of the visible surface that is confirmed, with its weighted area, with the
/// fraction of all that faces the sensor, and with the votes for the position.
double PoseExaminer::evidenceOf(const PoseEvidence& pose, std::uint32_t view, bool stands,
                                const Eigen::Vector3f& center, double density) const {
  if (stands) density = std::max(standing_density, density);
  const double gain = scene_.comparesColor(codebook_.views[view]) ? color_gain : 1;
  return gain * sampling(center) * fractionOf(pose) *
         std::sqrt(pose.weighted_supported / area_unit * coverageOf(pose)) * std::cbrt(density);
}

SightLines PoseExaminer::sightLines(const Hypothesis& hypothesis) const {
  return lookAlongRays(*models_.surfaces[hypothesis.view], scene_, settings_.verification, hypothesis.T_scene_model,
                       float(hypothesis.box_size.maxCoeff()));
}

/// How well the sensor samples a surface there, at most 1. The number of measurements on an area falls with the square
/// of the range, and what they are worth together with its root.
double PoseExaminer::sampling(const Eigen::Vector3f& position) const {
  const double range = double((position - scene_.surface.sensor_origin).norm());
  return samplingAt(range, double(scene_.range_image.sensorSpacing()), settings_.surface.normal_radius);
}

}  // namespace sks
