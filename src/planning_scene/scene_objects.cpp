// SPDX-License-Identifier: BSD-3-Clause
#include "planning_scene/scene_objects.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sks_detector {
namespace {

constexpr const char* support_id = "support";
constexpr double same_place = 0.5;           // of a box's longest side: an object found nearer is the same one
constexpr double min_support_growth = 0.02;  // [m] what is seen of a plane changes with what hides it

double rotationAngle(const Eigen::Matrix3d& rotation) {
  return Eigen::AngleAxisd(rotation).angle();
}

}  // namespace

double turnBetween(const SceneBox& a, const SceneBox& b) {
  const Eigen::Matrix3d between = a.T_scene_box.linear().transpose() * b.T_scene_box.linear();
  double angle = rotationAngle(between);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d half_turn = Eigen::Vector3d::Constant(-1);
    half_turn[axis] = 1;
    angle = std::min(angle, rotationAngle(between * half_turn.asDiagonal()));
  }
  return angle;
}

SceneChange SceneObjects::takeObjects(double stamp, const std::vector<SeenObject>& seen) {
  for (Entry& entry : entries_) entry.fresh = false;
  const std::vector<std::optional<std::size_t>> matches = match(seen);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!matches[i]) entries_.emplace_back();
    show(matches[i] ? entries_[*matches[i]] : entries_.back(), seen[i], stamp);
  }
  SceneChange change;
  std::vector<Entry> kept;
  for (Entry& entry : entries_) {
    const bool in_scene = !entry.object.id.empty();
    if (!entry.fresh) {
      const bool stays = in_scene && stamp - entry.seen_at <= settings_.remove_after;
      if (in_scene && !stays) change.removed.push_back(entry.object.id);
      if (stays) kept.push_back(entry);
      continue;
    }
    if (!in_scene && entry.frames >= settings_.add_after) entry.object.id = "object_" + std::to_string(next_number_++);
    const bool added = !in_scene && !entry.object.id.empty();
    if (added || (in_scene && countsAsMoved(entry, settings_.min_shift))) {
      entry.object.box = entry.last;
      change.put.push_back(entry.object);
    }
    kept.push_back(entry);
  }
  entries_ = std::move(kept);
  return change;
}

SceneChange SceneObjects::takeSupport(double stamp, const std::optional<SceneBox>& seen) {
  SceneChange change;
  if (!seen) {
    const bool in_scene = support_ && !support_->object.id.empty();
    if (in_scene && stamp - support_->seen_at <= settings_.remove_after) return change;
    if (in_scene) change.removed.emplace_back(support_id);
    support_.reset();
    return change;
  }
  if (!support_) support_ = Entry();
  show(*support_, {0, "", *seen}, stamp);
  const bool in_scene = !support_->object.id.empty();
  if (!in_scene && support_->frames < settings_.add_after) return change;
  if (in_scene && !countsAsMoved(*support_, std::max(settings_.min_shift, min_support_growth))) return change;
  support_->object.id = support_id;
  support_->object.box = support_->last;
  change.put.push_back(support_->object);
  return change;
}

SceneChange SceneObjects::clear() {
  SceneChange change;
  for (const SceneObject& object : all()) change.removed.push_back(object.id);
  entries_.clear();
  support_.reset();
  return change;
}

std::vector<SceneObject> SceneObjects::all() const {
  std::vector<SceneObject> objects;
  for (const Entry& entry : entries_) {
    if (!entry.object.id.empty()) objects.push_back(entry.object);
  }
  if (support_ && !support_->object.id.empty()) objects.push_back(support_->object);
  return objects;
}

/// The entry of each, by its track, else by its place, the nearest first; none where it is new.
std::vector<std::optional<std::size_t>> SceneObjects::match(const std::vector<SeenObject>& seen) const {
  std::vector<std::tuple<int, double, std::size_t, std::size_t>> pairs;  // by place, distance, entry, seen
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    for (std::size_t s = 0; s < seen.size(); ++s) {
      const SceneBox &before = entries_[e].last, &now = seen[s].box;
      if (entries_[e].object.name != seen[s].name) continue;
      const bool same_track = seen[s].track != 0 && seen[s].track == entries_[e].track;
      const double distance = (before.T_scene_box.translation() - now.T_scene_box.translation()).norm();
      if (!same_track && distance > same_place * now.size.maxCoeff()) continue;
      pairs.emplace_back(same_track ? 0 : 1, distance, e, s);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::optional<std::size_t>> matches(seen.size());
  std::vector<char> taken(entries_.size(), 0);
  for (const auto& [by_place, distance, e, s] : pairs) {
    if (taken[e] != 0 || matches[s]) continue;
    taken[e] = 1;
    matches[s] = e;
  }
  return matches;
}

/// Against what the scene holds. Along the z axis of a support, and of an object along any axis, `min_shift` counts.
bool SceneObjects::countsAsMoved(const Entry& entry, double min_growth) const {
  const SceneBox &in_scene = entry.object.box, &now = entry.last;
  const Eigen::Vector3d shift = now.T_scene_box.translation() - in_scene.T_scene_box.translation();
  const double along_z = std::abs(shift.dot(in_scene.T_scene_box.linear().col(2)));
  return shift.norm() > min_growth || along_z > settings_.min_shift ||
         (now.size - in_scene.size).cwiseAbs().maxCoeff() > min_growth ||
         turnBetween(in_scene, now) > settings_.min_turn;
}

void SceneObjects::show(Entry& entry, const SeenObject& seen, double stamp) const {
  entry.object.name = seen.name;
  entry.track = seen.track;
  entry.last = seen.box;
  entry.seen_at = std::max(entry.seen_at, stamp);
  entry.frames = std::min(entry.frames + 1, settings_.add_after);
  entry.fresh = true;
}

}  // namespace sks_detector
