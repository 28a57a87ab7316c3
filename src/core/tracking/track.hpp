// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>

#include "core/tracking/object_follower.hpp"
#include "core/tracking/pose_filter.hpp"

namespace sks {

/// An object that is followed: who it is, where it is in the reference frame, and how certain that is.
class Track {
public:
  /// @param T_reference_model where it was found in the cloud of `stamp`
  /// @param center of the object's box [m], model frame
  Track(std::uint32_t id, Hypothesis found, const Eigen::Isometry3d& T_reference_model, const Eigen::Vector3d& center,
        double stamp);

  std::uint32_t id() const { return id_; }
  /// As it was found last, in the frame of that cloud; its evidence pools those of the last clouds.
  const Hypothesis& hypothesis() const { return hypothesis_; }
  const PoseFilter& filter() const { return filter_; }
  const Eigen::Vector3d& center() const { return center_; }
  double score(const Settings& settings) const;

  bool seen() const { return seen_; }
  bool hidden() const { return hidden_; }        ///< not seen, but there is something in front of it
  bool confirmed() const { return confirmed_; }  ///< by another cloud than the one that it was found in
  double begun() const { return begun_; }        ///< [s]
  double seenAt() const { return seen_at_; }     ///< [s]
  /// By a full look, or the detection that it began with [s].
  double examinedAt() const { return examined_at_; }
  bool examined() const { return examined_; }  ///< by a full look since it began
  int searches() const { return searches_; }   ///< that found it with this pose, or none that is much better
  /// FollowedObject::color_shift of the last full look.
  const std::optional<Eigen::Vector3f>& colorShift() const { return color_shift_; }

  /// What a new cloud shows. @param T_reference_cloud of that cloud
  void update(const FollowedObject& followed, Look look, const Eigen::Isometry3d& T_reference_cloud, double stamp,
              double range);
  /// A search found it where it is, with a pose that is not much better.
  void foundHere() { ++searches_; }
  /// It was found somewhere else, or with a better pose, and is still the same object.
  void foundAgain(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp);
  /// Until it is seen it may as well be here; none: nowhere else.
  void alsoAt(const Eigen::Isometry3d& T_reference_model) { elsewhere_ = T_reference_model; }
  const std::optional<Eigen::Isometry3d>& elsewhere() const { return elsewhere_; }
  /// What is not seen moves with all else.
  void carry(const Eigen::Isometry3d& motion);
  /// What is known of it has moved so since knownAt().
  void carryFromKnown(const Eigen::Isometry3d& motion);
  /// Begins with another reference frame, in which nothing is known of its motion.
  void restart(const Eigen::Isometry3d& T_reference_model, double stamp);
  /// Pose in the reference frame at the time of an earlier cloud.
  Eigen::Isometry3d poseAt(double stamp) const;
  /// Pose in the reference frame in an earlier cloud, if a search found the object in it, or it was seen in it, and no
  /// search found it elsewhere since.
  std::optional<Eigen::Isometry3d> measuredAt(double stamp) const;
  /// Last time at which it was seen, or that of the cloud in which a search found it since [s].
  double knownAt() const { return known_.stamp; }

private:
  void pool(double evidence, double seconds);
  void remember(double stamp, bool measured);

  struct Past {
    double stamp;
    Eigen::Isometry3d T_reference_model;
    bool measured;  ///< the object was seen there, or found by a search
  };

  std::uint32_t id_;
  Hypothesis hypothesis_;
  Eigen::Vector3d center_;
  PoseFilter filter_;
  std::deque<Past> past_;
  Past known_;  // the last one that was measured
  std::optional<Eigen::Isometry3d> elsewhere_;
  bool seen_ = true, hidden_ = false, confirmed_ = false;
  double begun_, seen_at_;
  double examined_at_;
  bool examined_ = false;
  int searches_ = 1;
  std::optional<Eigen::Vector3f> color_shift_;
};

}  // namespace sks
