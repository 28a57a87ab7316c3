// SPDX-License-Identifier: BSD-3-Clause
// What a detection means for the tracks.
#include <limits>

#include "core/tracking/tracker_state.hpp"
#include "core/verification/pose_information.hpp"

namespace sks {
namespace {

constexpr double outdone_by = 1.25;  // times the evidence with which a detection takes the place of a track
constexpr double fastest = 1.0;      // [m/s] that a lost object is moved by a hand

}  // namespace

Hypothesis Tracker::State::hypothesisOf(const Detection& detection) const {
  Hypothesis hypothesis;
  const auto& names = codebook().objects;
  const auto object = std::find(names.begin(), names.end(), detection.object);
  const auto view = std::find_if(codebook().views.begin(), codebook().views.end(), [&](const TrainingView& v) {
    return v.frameName() == detection.view && names[v.object] == detection.object;
  });
  if (object == names.end() || view == codebook().views.end()) {
    throw Error(ErrorCode::bad_usage, "the detection of '" + detection.object + "' is not by the codebook '" +
                                          codebook().name + "' that objects are followed with");
  }
  hypothesis.object = std::uint32_t(object - names.begin());
  hypothesis.view = std::uint32_t(view - codebook().views.begin());
  hypothesis.T_scene_model = detection.T_scene_model;
  hypothesis.T_scene_box = detection.T_scene_box;
  hypothesis.box_size = detection.box_size;
  hypothesis.covariance = covarianceInModel(detection.covariance, detection.T_scene_model, centerOf(hypothesis.view));
  hypothesis.density = detection.density;
  hypothesis.evidence = detection.evidence;
  hypothesis.votes = detection.votes;
  hypothesis.stands = detection.votes == 0;
  return hypothesis;
}

/// The track that a detection belongs to: the nearest one of the same object, where it was then, or of which it is not
/// known where it is.
Track* Tracker::State::sameObject(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double then) {
  Track* same = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (Track& track : tracks) {
    if (track.hypothesis().object != found.object) continue;
    const double apart = (T_reference_model * centerOf(found.view) - track.poseAt(then) * track.center()).norm();
    const double moved = track.seen() ? 0 : fastest * std::max(0.0, stamp - track.seenAt());
    if (apart >= settings().voting.suppression_radius + moved || apart >= nearest) continue;
    nearest = apart;
    same = &track;
  }
  return same;
}

/// A seen track of another object in whose box the found one has its centre, or the other way around.
Track* Tracker::State::atPlaceOf(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double then) {
  const Eigen::Vector3d center = T_reference_model * centerOf(found.view);
  const OccupiedBox box{T_reference_model * Eigen::Translation3d(centerOf(found.view)), found.box_size};
  for (Track& track : tracks) {
    const Eigen::Isometry3d T_reference_box = track.poseAt(then) * Eigen::Translation3d(track.center());
    const OccupiedBox other{T_reference_box, track.hypothesis().box_size};
    if (track.seen() && (other.contains(center) || box.contains(T_reference_box.translation()))) return &track;
  }
  return nullptr;
}

/// @param motion motionSinceSearched(), once a detection has asked for it
void Tracker::State::takeOne(const Detection& detection, const CloudView& view,
                             std::optional<Eigen::Isometry3d>& motion) {
  const Hypothesis found = hypothesisOf(detection);
  const Eigen::Isometry3d T_reference_model = referenceOf(view) * found.T_scene_model;
  if (Track* same = sameObject(found, T_reference_model, view.stamp)) {
    const bool better_pose = found.evidence > outdone_by * same->hypothesis().evidence;
    if (same->seen() && !better_pose) return same->foundHere();
    if (!motion) motion = motionSinceSearched(view.stamp);
    if (!same->seen()) ++counts.found_again;
    same->foundAgain(found, T_reference_model, view.stamp);
    same->carryFromKnown(*motion);
    same->alsoAt(T_reference_model);
    return;
  }
  if (Track* other = atPlaceOf(found, T_reference_model, view.stamp)) {
    if (found.evidence <= outdone_by * other->hypothesis().evidence) return;
    ++counts.identity_changes;
    tracks.erase(tracks.begin() + (other - tracks.data()));
  }
  if (!motion) motion = motionSinceSearched(view.stamp);
  tracks.emplace_back(next_id++, found, T_reference_model, centerOf(found.view), view.stamp);
  tracks.back().carryFromKnown(*motion);
  tracks.back().alsoAt(T_reference_model);
  ++counts.begun;
}

}  // namespace sks
