// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/standing_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sks {
namespace {

constexpr float size_tolerance = 0.01f;   // [m] of what is measured of a thing
constexpr float least_seen = 0.4f;        // of an object's length
constexpr std::size_t most_points = 200;  // of a model, to estimate what is seen of it

bool fits(const RestingModel& model, const StandingThing& thing) {
  const float model_diagonal = std::hypot(model.rest.base.length, model.rest.base.width);
  return std::abs(model.rest.height - thing.height) < size_tolerance &&
         thing.base.length < model_diagonal + size_tolerance && thing.base.length > least_seen * model.rest.base.length;
}

/// The model on the thing's plane, its long axis rotated from that of the thing, where what the sensor would see of it
/// has the centroid of what it saw.
Eigen::Isometry3d placed(const RestingModel& model, const StandingThing& thing, float yaw,
                         const Eigen::Vector3f& sensor) {
  const Eigen::Vector3f down = -thing.up;
  const Eigen::Matrix3f R = model.rest.rotation(thing.up, thing.base.long_axis, yaw);
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

std::vector<PoseCandidate> standingCandidates(const VerifiedModels& models, const std::vector<StandingThing>& things,
                                              const SceneView& scene, int threads) {
  std::vector<std::vector<PoseCandidate>> of_things(things.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t t = 0; t < things.size(); ++t) {
    const StandingThing& thing = things[t];
    for (const RestingModel& model : models.resting) {
      if (!fits(model, thing)) continue;
      PoseCandidate best;
      for (int k = 0; k < upright_rotations; ++k) {
        PoseCandidate candidate;
        candidate.object = model.object;
        candidate.T_scene_model =
            placed(model, thing, float(2 * EIGEN_PI * k / upright_rotations), scene.surface.sensor_origin);
        candidate.view = nearestView(*model.surface, scene.surface.sensor_origin, candidate.T_scene_model);
        candidate.pre_score =
            roughSupport(models.rough[candidate.view], scene, candidate.T_scene_model, RoughLimits(), best.pre_score)
                .scoreWithoutVotes();
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
