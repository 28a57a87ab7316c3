// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/detector.hpp>

namespace sks {

/// When and from where a cloud was seen.
struct CloudView {
  double stamp = 0;  ///< [s]
  /// Pose of the cloud's frame in a frame in which things stand still though the camera moves; none: not known, then
  /// objects are followed in the frame of the cloud.
  std::optional<Eigen::Isometry3d> T_fixed_cloud;
};

/// An object that is followed from cloud to cloud.
struct TrackedObject {
  std::uint32_t id = 0;  ///< from 1; no other object ever has it
  /// In the frame of the cloud. Evidence and score pool those of the last clouds; they mean the same as a detection's.
  Detection detection;
  bool seen = false;  ///< in this cloud; else it is hidden, and the pose is where it should be
  double age = 0;     ///< since it was first seen [s]
  double unseen = 0;  ///< since it was last seen [s]; at most `tracker.max_age`
};

/// What a tracker has done so far.
struct TrackingCounts {
  std::uint64_t begun = 0;             ///< objects that were followed
  std::uint64_t lost = 0;              ///< of these, not seen for `tracker.max_age`
  std::uint64_t found_again = 0;       ///< by a detection elsewhere, before that
  std::uint64_t identity_changes = 0;  ///< objects that turned out to be another one
};

/// Follows what a Detector found, at the camera's rate. Each object is refined and verified in the part of a new cloud
/// where it is expected, by the same evidence as a detection; only what is new is left to be searched for:
///
///     tracked = tracker.follow(cloud, view);                       // each cloud
///     if (tracker.wantsDetection(view.stamp))                      // now and then, perhaps in another thread
///       tracker.take(detector.detect(cloud, nullptr, tracker.occupied()), view);
///
/// A track that was not seen for `tracker.max_age` ends. An object is told once two clouds have shown it, and stays
/// as long as the pooled score of its last clouds does: a single doubtful cloud neither makes nor loses it.
/// Deterministic for the same calls, whatever `threads` is. Not thread-safe; detections of earlier clouds may be taken.
class Tracker {
public:
  /// @param detector its codebook, settings and models are shared
  /// @param first_id of the first object; of a tracker that replaces another one its nextId()
  /// @throws Error(bad_usage) where poses are not verified: `detection.hypotheses` is not `verified`, or the user has a
  ///         verifier of their own
  explicit Tracker(const Detector& detector, std::uint32_t first_id = 1);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// The objects in a new cloud, the most certain first: those that are seen, and those that stood still and are
  /// hidden, whose score falls to 0 by `tracker.max_age`. A stamp before that of the last cloud ends all tracks: time
  /// has jumped.
  /// @throws Error(incompatible) for a cloud without colour with CSHOT
  std::vector<TrackedObject> follow(const Cloud& cloud, const CloudView& view);

  /// Begins tracks with what was found in a cloud, finds lost ones again, and forgets those that turned out to be
  /// something else. Detections below the threshold of their object do not count.
  /// @param view of the cloud that was searched: the last one or an earlier one of the last few seconds
  void take(const DetectionResult& result, const CloudView& view);

  /// Whether the scene should be searched: never done, `tracker.redetect` ago, or something is neither seen nor
  /// hidden.
  bool wantsDetection(double stamp) const;

  /// Where there is no need to search, in the frame of the last cloud: objects that are seen with hardly a doubt, and
  /// that two searches have found.
  std::vector<OccupiedBox> occupied() const;

  /// Ends all tracks.
  void clear();
  std::size_t size() const;  ///< tracks, seen or not
  const TrackingCounts& counts() const;
  std::uint32_t nextId() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sks
