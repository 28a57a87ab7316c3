// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/tracker.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <sks_detector/thresholds.hpp>

#include "core/tracking/tracker_state.hpp"
#include "core/verification/color_shift.hpp"

namespace sks {
namespace {

constexpr double sure_score = 0.9;  // what is seen with this score need not be searched for,
constexpr int sure_searches = 2;    // if as many searches found it: one cloud may show a box by half a turn

double timeOrNever(bool ever, double stamp) {
  return ever ? stamp : -std::numeric_limits<double>::infinity();
}

}  // namespace

Tracker::Tracker(const Detector& detector, std::uint32_t first_id)
    : state_(std::make_unique<State>(detector, first_id)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

std::vector<TrackedObject> Tracker::follow(const Cloud& cloud, const CloudView& view) {
  State& s = *state_;
  const double before = s.stamp;
  s.enter(view);
  if (!s.fixed) s.scene_motion.add(cloud, view.stamp);
  const std::vector<Look> looks = s.looks(view.stamp);
  const std::vector<FollowedObject> found = s.look(cloud, view, looks);
  std::vector<Examined> colors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3d place = found[i].hypothesis.T_scene_model * s.tracks[i].center();
    const double range = (place - cloud.sensor_origin.cast<double>()).norm();
    s.tracks[i].update(found[i], looks[i], s.T_reference_cloud, view.stamp, range);
    Examined examined;
    examined.hypothesis = s.tracks[i].hypothesis();
    examined.lines.color_shift = s.tracks[i].colorShift();
    colors.push_back(std::move(examined));
  }
  if (!colors.empty()) {
    s.color_shift = sceneColorShift(colors, color_doubt * s.settings().verification.half_evidence);
  }
  s.carryUnseen(before);
  s.keepStep(before);
  s.dropDoubles();
  s.dropOld(view.stamp);
  std::vector<TrackedObject> objects;
  for (const Track& track : s.tracks) {
    const bool remembered = track.hidden() && track.filter().stands();
    if (track.confirmed() && (track.seen() || remembered)) objects.push_back(s.told(track, view.stamp));
  }
  std::stable_sort(objects.begin(), objects.end(), [](const TrackedObject& a, const TrackedObject& b) {
    return a.detection.score > b.detection.score;
  });
  return objects;
}

void Tracker::take(const DetectionResult& result, const CloudView& view) {
  State& s = *state_;
  s.searched = true;
  s.searched_at = view.stamp;
  if (view.T_fixed_cloud.has_value() != s.fixed && s.followed) return;  // of another reference frame: too late
  if (!s.followed) s.enter(view);
  std::optional<Eigen::Isometry3d> motion;
  for (const Detection& detection : result.above(Thresholds(s.settings().detection)))
    s.takeOne(detection, view, motion);
}

bool Tracker::wantsDetection(double stamp) const {
  const State& s = *state_;
  if (stamp - timeOrNever(s.searched, s.searched_at) >= s.settings().tracker.redetect) return true;
  return std::any_of(s.tracks.begin(), s.tracks.end(), [](const Track& t) { return !t.seen() && !t.hidden(); });
}

std::vector<OccupiedBox> Tracker::occupied() const {
  const State& s = *state_;
  std::vector<OccupiedBox> boxes;
  for (const Track& track : s.tracks) {
    const bool sure = track.score(s.settings()) >= sure_score && track.searches() >= sure_searches;
    if (!track.seen() || !track.confirmed() || !sure) continue;
    boxes.push_back({s.T_reference_cloud.inverse() * track.filter().pose() * Eigen::Translation3d(track.center()),
                     track.hypothesis().box_size});
  }
  return boxes;
}

void Tracker::clear() {
  state_->tracks.clear();
  state_->searched = false;
}

std::size_t Tracker::size() const {
  return state_->tracks.size();
}

const TrackingCounts& Tracker::counts() const {
  return state_->counts;
}

std::uint32_t Tracker::nextId() const {
  return state_->next_id;
}

}  // namespace sks
