// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pile_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sks {
namespace {

constexpr float part_tolerance = 0.01f;    // [m] of what is measured of a part
constexpr float least_of_object = 0.6f;    // of its length
constexpr float most_joined = 2;           // times an object's extents: a part may be of several that touch
constexpr float nearly_square = 0.8f;      // width over length: the axes of its extents may lie anyhow
constexpr float same_end = 0.01f;          // [m] ends that near need not be tried, too
constexpr std::size_t most_of_part = 24;   // poses
constexpr std::size_t most_looked_at = 6;  // poses of one object at a part with all points, after a glance at all

bool mayBelong(const RestingModel& model, const PilePart& part) {
  const BaseExtent& base = model.rest.base;
  if (part.stick ? !model.rest.isStick() : !model.rest.flat_top) return false;
  const float diagonal = std::hypot(base.length, base.width);
  const float width = base.width > nearly_square * base.length ? diagonal : base.width;
  return part.base.length < most_joined * diagonal + part_tolerance &&
         part.base.width < most_joined * width + part_tolerance &&
         part.base.length > least_of_object * base.length - part_tolerance;
}

/// The model with its top at the part, its long axis rotated from that of the part.
Eigen::Isometry3d atPart(const RestingModel& model, const PilePart& part, float yaw) {
  const Eigen::Matrix3f R = model.rest.rotation(part.up, part.base.long_axis, yaw);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R.cast<double>();
  T.translation() = (part.centroid - R * model.rest.top).cast<double>();
  return T;
}

/// Where an object may lie at a part, and from which view it is looked at there.
class Places {
public:
  Places(const RestingModel& model, const PilePart& part, const Eigen::Vector3f& sensor)
      : model_(model), part_(part), sensor_(sensor) {
    rotate();
    shift();
  }

  struct Place {
    Eigen::Isometry3d T_scene_model;
    std::uint32_t view;
  };
  const std::vector<Place>& all() const { return all_; }

private:
  /// In rotations about the middle.
  void rotate() {
    for (int k = 0; k < upright_rotations; ++k) {
      const Eigen::Isometry3d T = atPart(model_, part_, float(2 * EIGEN_PI * k / upright_rotations));
      all_.push_back({T, viewOf(T)});
    }
  }

  /// Along the part's axes, where an end or a corner of the object lies at one of the part.
  void shift() {
    const Eigen::Vector3f along = part_.base.long_axis, across = part_.up.cross(along);
    for (int quarter = 0; quarter < 4; ++quarter) {
      const bool crosswise = quarter % 2 == 1;
      const BaseExtent& base = model_.rest.base;
      const float by_length = 0.5f * (part_.base.length - (crosswise ? base.width : base.length));
      const float by_width = 0.5f * (part_.base.width - (crosswise ? base.length : base.width));
      const Eigen::Isometry3d T = atPart(model_, part_, float(0.5 * EIGEN_PI * quarter));
      const std::uint32_t view = viewOf(T);
      for (const float a : stepsOf(by_length)) {
        for (const float b : stepsOf(by_width)) {
          const Eigen::Vector3f offset = a * along + b * across;
          if (a != 0 || b != 0) all_.push_back({Eigen::Translation3d(offset.cast<double>()) * T, view});
        }
      }
    }
  }

  static std::vector<float> stepsOf(float end) {
    if (std::abs(end) < same_end) return {0};
    return {0, end, -end};
  }

  std::uint32_t viewOf(const Eigen::Isometry3d& T) const { return nearestView(*model_.surface, sensor_, T); }

  const RestingModel& model_;
  const PilePart& part_;
  Eigen::Vector3f sensor_;
  std::vector<Place> all_;
};

/// The best pose of an object at a part; its score is 0 if none is any good.
PoseCandidate bestAt(const PilePart& part, const RestingModel& model, const VerifiedModels& models,
                     const SceneView& scene) {
  const Places places(model, part, scene.surface.sensor_origin);
  RoughLimits glance;
  glance.glance = true;
  std::vector<std::pair<double, const Places::Place*>> glances;  // the best ones and their scores, best first
  for (const Places::Place& place : places.all()) {
    const double least = glances.size() < most_looked_at ? 0 : glances.back().first;
    const RoughSupport support = roughSupport(models.rough[place.view], scene, place.T_scene_model, glance, least);
    const double score = support.scoreWithoutVotes();
    if (score <= least) continue;
    const auto at =
        std::find_if(glances.begin(), glances.end(), [&](const auto& other) { return other.first < score; });
    glances.insert(at, {score, &place});
    if (glances.size() > most_looked_at) glances.pop_back();
  }
  PoseCandidate best;
  best.object = model.object;
  best.stands = true;
  for (const auto& [score, place] : glances) {
    const RoughSupport support =
        roughSupport(models.rough[place->view], scene, place->T_scene_model, RoughLimits(), best.pre_score);
    if (support.scoreWithoutVotes() <= best.pre_score) continue;
    best.view = place->view, best.T_scene_model = place->T_scene_model, best.pre_score = support.scoreWithoutVotes();
  }
  return best;
}

std::vector<PoseCandidate> candidatesAt(const PilePart& part, const VerifiedModels& models, const SceneView& scene) {
  std::vector<PoseCandidate> candidates;
  for (const RestingModel& model : models.resting) {
    if (!mayBelong(model, part)) continue;
    const PoseCandidate best = bestAt(part, model, models, scene);
    if (best.pre_score > 0) candidates.push_back(best);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.pre_score > b.pre_score; });
  if (candidates.size() > most_of_part) candidates.resize(most_of_part);
  return candidates;
}

}  // namespace

std::vector<PoseCandidate> pileCandidates(const VerifiedModels& models, const std::vector<PilePart>& parts,
                                          const SceneView& scene, int threads) {
  std::vector<std::vector<PoseCandidate>> of_parts(parts.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t p = 0; p < parts.size(); ++p) of_parts[p] = candidatesAt(parts[p], models, scene);
  std::vector<PoseCandidate> all;
  for (const auto& candidates : of_parts) all.insert(all.end(), candidates.begin(), candidates.end());
  return all;
}

}  // namespace sks
