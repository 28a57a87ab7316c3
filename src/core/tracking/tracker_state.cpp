// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/tracker_state.hpp"

#include <tuple>
#include <utility>

#include "core/pipeline/to_detection.hpp"
#include "core/settings/threads.hpp"

namespace sks {
namespace {

constexpr double examination = 0.5;  // [s] between full looks at an object

}  // namespace

/// Begins with a new cloud; where time or the reference frame has changed, with what that leaves.
void Tracker::State::enter(const CloudView& view) {
  if (followed && view.stamp < stamp) {
    tracks.clear();
    scene_motion.clear();
    searched = false;
  }
  const Eigen::Isometry3d before = T_reference_cloud;
  T_reference_cloud = referenceOf(view);
  if (view.T_fixed_cloud.has_value() != fixed) {
    for (Track& track : tracks) track.restart(T_reference_cloud * before.inverse() * track.filter().pose(), view.stamp);
  }
  fixed = view.T_fixed_cloud.has_value();
  stamp = view.stamp;
  followed = true;
}

/// A full look at the object that waits longest for it, if one does: more of them in one cloud would hold it up. One
/// that never had any comes first.
std::vector<Look> Tracker::State::looks(double now) const {
  std::vector<Look> looks(tracks.size(), Look::quick);
  const auto longest = std::min_element(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
    return std::make_tuple(a.examined(), a.examinedAt()) < std::make_tuple(b.examined(), b.examinedAt());
  });
  if (longest != tracks.end() && (!longest->examined() || now - longest->examinedAt() >= examination)) {
    looks[std::size_t(longest - tracks.begin())] = Look::full;
  }
  return looks;
}

std::vector<FollowedObject> Tracker::State::look(const Cloud& cloud, const CloudView& view,
                                                 const std::vector<Look>& looks) const {
  std::vector<FollowedObject> found(tracks.size());
  const Eigen::Isometry3d T_cloud_reference = T_reference_cloud.inverse();
  const std::optional<Eigen::Isometry3d> step = stepTo(view.stamp);
#pragma omp parallel for schedule(dynamic, 1) num_threads(startableThreads(settings()))
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const PoseFilter& filter = tracks[i].filter();
    std::vector<Eigen::Isometry3d> starts;
    if (step) starts.push_back(T_cloud_reference * *step * filter.pose());  // with the camera's motion, as what stands
    if (!step || !filter.stands()) starts.push_back(T_cloud_reference * filter.predicted(view.stamp));
    if (!step && !filter.stands()) starts.push_back(T_cloud_reference * filter.pose());  // or it has stopped
    if (tracks[i].elsewhere()) starts.push_back(T_cloud_reference * *tracks[i].elsewhere());
    found[i] = follower.follow(cloud, tracks[i].hypothesis(), starts, color_shift, looks[i]);
  }
  return found;
}

/// One thing is not there twice: of two tracks of an object at one place the older one stays.
void Tracker::State::dropDoubles() {
  std::vector<Track> kept;
  for (Track& track : tracks) {
    const bool is_double = std::any_of(kept.begin(), kept.end(), [&](const Track& other) {
      const Eigen::Vector3d apart = track.filter().pose() * track.center() - other.filter().pose() * other.center();
      return other.hypothesis().object == track.hypothesis().object && other.seen() && track.seen() &&
             apart.norm() < settings().voting.suppression_radius;
    });
    if (!is_double) kept.push_back(std::move(track));
  }
  tracks = std::move(kept);
}

void Tracker::State::dropOld(double now) {
  const auto is_old = [&](const Track& track) { return now - track.seenAt() > settings().tracker.max_age; };
  const auto first = std::stable_partition(tracks.begin(), tracks.end(), [&](const Track& t) { return !is_old(t); });
  counts.lost += std::uint64_t(std::count_if(first, tracks.end(), [](const Track& t) { return t.confirmed(); }));
  tracks.erase(first, tracks.end());
}

TrackedObject Tracker::State::told(const Track& track, double now) const {
  Hypothesis hypothesis = track.hypothesis();
  hypothesis.T_scene_model = T_reference_cloud.inverse() * track.filter().pose();
  hypothesis.T_scene_box = hypothesis.T_scene_model * Eigen::Translation3d(track.center());
  TrackedObject object;
  object.id = track.id();
  object.seen = track.seen();
  object.age = now - track.begun();
  object.unseen = now - track.seenAt();
  const double left = 1 - object.unseen / settings().tracker.max_age;
  object.detection = toDetection(codebook(), hypothesis, track.score(settings()) * std::max(0.0, left));
  return object;
}

}  // namespace sks
