// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <sks_detector/error.hpp>
#include <sks_detector/tracker.hpp>

#include "core/pipeline/default_stages.hpp"
#include "core/tracking/object_follower.hpp"
#include "core/tracking/scene_motion.hpp"
#include "core/tracking/track.hpp"

namespace sks {

/// What a tracker knows, and the steps of its work.
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
  std::optional<Eigen::Isometry3d> motionSince(double then, std::ptrdiff_t least_alike = 1) const;
  Eigen::Isometry3d motionSinceSearched(double then) const;
  std::optional<Eigen::Isometry3d> stepTo(double next) const;
  void keepStep(double last);
  void carryUnseen(double last);
  void dropDoubles();
  void dropOld(double stamp);
  TrackedObject told(const Track& track, double stamp) const;
  void takeOne(const Detection& detection, const CloudView& view, std::optional<Eigen::Isometry3d>& motion);
  Hypothesis hypothesisOf(const Detection& detection) const;
  Track* sameObject(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp);
  Track* atPlaceOf(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp);

  Detector detector;
  ObjectFollower follower;
  std::vector<Track> tracks;
  SceneMotion scene_motion;  // of clouds without a fixed frame
  TrackingCounts counts;
  std::uint32_t next_id;
  Eigen::Vector3f color_shift = Eigen::Vector3f::Zero();
  Eigen::Isometry3d T_reference_cloud = Eigen::Isometry3d::Identity();  // of the last cloud
  bool fixed = false;  // the reference is a frame in which things stand still
  bool followed = false, searched = false;
  std::optional<Eigen::Isometry3d> last_step;  // motionSince() the cloud before the last one
  double last_step_took = 0, last_stamp = 0;   // [s]
  double stamp = 0, searched_at = 0;           // [s]
};

}  // namespace sks
