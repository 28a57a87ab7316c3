// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/tracker.hpp>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/to_detection.hpp"
#include "core/settings/threads.hpp"
#include "core/tracking/object_follower.hpp"
#include "core/tracking/track.hpp"
#include "core/verification/color_shift.hpp"

namespace sks {
namespace {

constexpr double examination = 0.5;   // [s] between full looks at an object
constexpr double sure_score = 0.9;    // what is seen with this score need not be searched for
constexpr double outdone_by = 1.25;   // times the evidence with which a detection takes the place of a track
constexpr double same_motion = 0.01;  // [m] by which centres may be off that move alike
constexpr double fastest = 1.0;       // [m/s] that a lost object is moved by a hand

double timeOrNever(bool ever, double stamp) {
  return ever ? stamp : -std::numeric_limits<double>::infinity();
}

}  // namespace

struct Tracker::State {
  State(const Detector& used, std::uint32_t first_id)
      : detector(used), follower(checked(used), used.settings()), next_id(std::max(1u, first_id)) {}

  static std::shared_ptr<const VerifiedModels> checked(const Detector& used) {
    if (used.models_ && verifiesPoses(used.settings())) return used.models_;
    throw Error(ErrorCode::bad_usage,
                "objects are followed by the surface that verifies their poses: tracking needs detection.hypotheses = "
                "verified and no verifier of the user's own");
  }

  const Settings& settings() const { return detector.settings(); }
  const Codebook& codebook() const { return detector.codebook(); }
  Eigen::Vector3d centerOf(std::uint32_t view) const { return codebook().views[view].center().cast<double>(); }
  static Eigen::Isometry3d referenceOf(const CloudView& view) {
    return view.T_fixed_cloud.value_or(Eigen::Isometry3d::Identity());
  }

  void enter(const CloudView& view);
  std::vector<Look> looks(double stamp) const;
  std::vector<FollowedObject> look(const Cloud& cloud, const CloudView& view, const std::vector<Look>& looks) const;
  Eigen::Isometry3d motionSince(double then) const;
  void dropDoubles();
  void dropOld(double stamp);
  TrackedObject told(const Track& track, double stamp) const;
  void takeOne(const Detection& detection, const CloudView& view);
  Hypothesis hypothesisOf(const Detection& detection) const;
  Track* sameObject(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp);
  Track* atPlaceOf(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp);

  Detector detector;
  ObjectFollower follower;
  std::vector<Track> tracks;
  TrackingCounts counts;
  std::uint32_t next_id;
  Eigen::Vector3f color_shift = Eigen::Vector3f::Zero();
  Eigen::Isometry3d T_reference_cloud = Eigen::Isometry3d::Identity();  // of the last cloud
  bool fixed = false;  // the reference is a frame in which things stand still
  bool followed = false, searched = false;
  double stamp = 0, searched_at = 0;  // [s]
};

/// Begins with a new cloud; where time or the reference frame has changed, with what that leaves.
void Tracker::State::enter(const CloudView& view) {
  if (followed && view.stamp < stamp) {
    tracks.clear();
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
#pragma omp parallel for schedule(dynamic, 1) num_threads(startableThreads(settings()))
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const PoseFilter& filter = tracks[i].filter();
    std::vector<Eigen::Isometry3d> starts{T_cloud_reference * filter.predicted(view.stamp)};
    if (!filter.stands()) starts.push_back(T_cloud_reference * filter.pose());  // or it has stopped
    if (tracks[i].elsewhere()) starts.push_back(T_cloud_reference * *tracks[i].elsewhere());
    found[i] = follower.follow(cloud, tracks[i].hypothesis(), starts, color_shift, looks[i]);
  }
  return found;
}

/// Where no frame is known in which things stand still: how most of what is seen has moved in the frame of the cloud
/// since an earlier cloud, for the camera has moved. Else, and where nothing tells, not at all.
Eigen::Isometry3d Tracker::State::motionSince(double then) const {
  Eigen::Isometry3d common = Eigen::Isometry3d::Identity();
  std::ptrdiff_t most = 0;
  if (fixed) return common;
  const auto tells = [&](const Track& track) { return track.seen() && track.confirmed() && track.begun() <= then; };
  for (const Track& track : tracks) {
    if (!tells(track)) continue;
    const Eigen::Isometry3d motion = track.filter().pose() * track.poseAt(then).inverse();
    const std::ptrdiff_t alike = std::count_if(tracks.begin(), tracks.end(), [&](const Track& other) {
      const Eigen::Vector3d moved = motion * (other.poseAt(then) * other.center());
      return tells(other) && (moved - other.filter().pose() * other.center()).norm() < same_motion;
    });
    if (alike <= most) continue;
    most = alike;
    common = motion;
  }
  return common;
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

void Tracker::State::takeOne(const Detection& detection, const CloudView& view) {
  const Hypothesis found = hypothesisOf(detection);
  const Eigen::Isometry3d T_reference_model = referenceOf(view) * found.T_scene_model;
  const Eigen::Isometry3d T_now_model = motionSince(view.stamp) * T_reference_model;
  if (Track* same = sameObject(found, T_reference_model, view.stamp)) {
    const bool better_pose = found.evidence > outdone_by * same->hypothesis().evidence;
    if (same->seen() && !better_pose) return;
    if (!same->seen()) ++counts.found_again;
    same->foundAgain(found, T_now_model, view.stamp);
    same->alsoAt(T_reference_model);
    return;
  }
  if (Track* other = atPlaceOf(found, T_reference_model, view.stamp)) {
    if (found.evidence <= outdone_by * other->hypothesis().evidence) return;
    ++counts.identity_changes;
    tracks.erase(tracks.begin() + (other - tracks.data()));
  }
  tracks.emplace_back(next_id++, found, T_now_model, centerOf(found.view), view.stamp);
  tracks.back().alsoAt(T_reference_model);
  ++counts.begun;
}

Tracker::Tracker(const Detector& detector, std::uint32_t first_id)
    : state_(std::make_unique<State>(detector, first_id)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

std::vector<TrackedObject> Tracker::follow(const Cloud& cloud, const CloudView& view) {
  State& s = *state_;
  const double before = s.stamp;
  s.enter(view);
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
  const Eigen::Isometry3d motion = s.motionSince(before);
  for (Track& track : s.tracks) {
    if (!track.seen()) track.carry(motion);
  }
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
  for (const Detection& detection : result.above(s.settings().detection.threshold)) s.takeOne(detection, view);
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
    if (!track.seen() || !track.confirmed() || track.score(s.settings()) < sure_score) continue;
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
