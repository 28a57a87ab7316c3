// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/standing_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sks {
namespace {

constexpr float size_tolerance = 0.01f;   // [m] of what is measured of a thing
constexpr float least_seen = 0.4f;        // of an object's length
constexpr int yaws = 12;                  // rotations about the upright axis; the nearest one is at most 15 degrees off
constexpr std::size_t most_points = 200;  // of a model, to estimate what is seen of it
constexpr int fewest_confirmed = 6;       // points
constexpr double prior_of_check = 0.2;    // as of votes

/// An object in one of its resting poses.
struct RestingModel {
  std::uint32_t object = 0;
  const ModelSurface* surface = nullptr;
  RestingPose rest;
};

bool fits(const RestingModel& model, const StandingThing& thing) {
  const float model_diagonal = std::hypot(model.rest.base.length, model.rest.base.width);
  return std::abs(model.rest.height - thing.height) < size_tolerance &&
         thing.base.length < model_diagonal + size_tolerance && thing.base.length > least_seen * model.rest.base.length;
}

/// The model on the thing's plane, its long axis rotated from that of the thing, where what the sensor would see of it
/// has the centroid of what it saw.
Eigen::Isometry3d placed(const RestingModel& model, const StandingThing& thing, float yaw,
                         const Eigen::Vector3f& sensor) {
  Eigen::Matrix3f from, to;  // columns: down, long axis, and across
  from << model.rest.down, model.rest.base.long_axis, model.rest.down.cross(model.rest.base.long_axis);
  const Eigen::Vector3f down = -thing.up, across = down.cross(thing.base.long_axis);
  const Eigen::Vector3f axis = std::cos(yaw) * thing.base.long_axis + std::sin(yaw) * across;
  to << down, axis, down.cross(axis);
  const Eigen::Matrix3f R = to * from.transpose();
  const Eigen::Vector3f ray = thing.centroid - sensor;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int count = 0;
  const ModelSurface& surface = *model.surface;
  for (std::size_t i = 0; i < surface.points.size(); i += surface.points.size() / most_points + 1) {
    if ((R * surface.normals[i]).dot(ray) >= 0) continue;
    sum += surface.points[i];
    ++count;
  }
  const Eigen::Vector3f seen = count > 0 ? Eigen::Vector3f(sum / float(count)) : Eigen::Vector3f::Zero();
  Eigen::Vector3f translation = thing.centroid - R * seen;
  // Along the upright axis the plane knows better.
  translation -= (thing.floor + model.rest.floor + down.dot(translation)) * down;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R.cast<double>();
  T.translation() = translation.cast<double>();
  return T;
}

}  // namespace

std::vector<PoseCandidate> standingCandidates(const VerifiedModels& models, const StandingThings& standing,
                                              const SceneView& scene, int threads) {
  const Codebook& codebook = *models.codebook;
  std::vector<RestingModel> resting;
  for (std::uint32_t v = 0; v < codebook.views.size(); ++v) {
    const ModelSurface& surface = *models.surfaces[v];
    if (surface.views.size() < 2 || surface.views.front() != v) continue;
    for (const RestingPose& rest : models.resting[v]) resting.push_back({codebook.views[v].object, &surface, rest});
  }
  std::vector<std::vector<PoseCandidate>> of_things(standing.things.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t t = 0; t < standing.things.size(); ++t) {
    const StandingThing& thing = standing.things[t];
    for (const RestingModel& model : resting) {
      if (!fits(model, thing)) continue;
      PoseCandidate best;
      for (int k = 0; k < yaws; ++k) {
        PoseCandidate candidate;
        candidate.object = model.object;
        candidate.T_scene_model = placed(model, thing, float(2 * EIGEN_PI * k / yaws), scene.surface.sensor_origin);
        candidate.view = nearestView(codebook, *model.surface, scene.surface.sensor_origin, candidate.T_scene_model);
        const RoughSupport support = roughSupport(models.rough[candidate.view], scene, candidate.T_scene_model);
        if (support.points < fewest_confirmed) continue;
        candidate.pre_score = support.supported / (support.visible + prior_of_check) * std::sqrt(support.supported);
        if (candidate.pre_score > best.pre_score) best = candidate;
      }
      best.stands = true;
      if (best.pre_score > 0) of_things[t].push_back(best);
    }
  }
  std::vector<PoseCandidate> all;
  for (const auto& candidates : of_things) all.insert(all.end(), candidates.begin(), candidates.end());
  return all;
}

}  // namespace sks
