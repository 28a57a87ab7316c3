// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/verification/pose_information.hpp"
#include "core/verification/score.hpp"

namespace sks {
namespace {

constexpr double pooling = 1.5;          // [s] after which a full look has lost two thirds of its say in the evidence
constexpr double kept_past = 5;          // [s] within which the detection of an earlier cloud has to arrive
constexpr double mostly_hidden = 0.3;    // share of the surface: then little evidence speaks neither way
constexpr double agrees = 1.0 / 3;       // least share of what should be seen that a cloud has to confirm
constexpr double agrees_at_first = 0.5;  // of an object that was found elsewhere: it may have moved on since
constexpr double least_in_sight = 0.2;   // share of the surface that faces the sensor: with less no pose is measured
constexpr double smallest_evidence = 1e-6;  // whose logarithm is taken

}  // namespace

Track::Track(std::uint32_t id, Hypothesis found, const Eigen::Isometry3d& T_reference_model,
             const Eigen::Vector3d& center, double stamp)
    : id_(id),
      hypothesis_(std::move(found)),
      center_(center),
      filter_(T_reference_model, center, stamp),
      begun_(stamp),
      seen_at_(stamp),
      examined_at_(stamp) {
  remember(stamp, true);
}

double Track::score(const Settings& settings) const {
  return scoreOfEvidence(hypothesis_, settings);
}

void Track::update(const FollowedObject& followed, Look look, const Eigen::Isometry3d& T_reference_cloud, double stamp,
                   double range) {
  const bool partly_hidden = followed.hidden > mostly_hidden;
  // A part in sight that agrees, however small, says that the object is still there.
  seen_ = followed.confirmed >= (confirmed_ ? agrees : agrees_at_first) && 1 - followed.hidden >= least_in_sight;
  hidden_ = !seen_ && partly_hidden;
  const double evidence = followed.hypothesis.evidence, pooled = hypothesis_.evidence;
  if (seen_) {
    hypothesis_ = followed.hypothesis;
    hypothesis_.evidence = pooled;
    filter_.update(T_reference_cloud * followed.hypothesis.T_scene_model, stamp, depthNoise(range));
    seen_at_ = stamp;
    confirmed_ = true;
    elsewhere_.reset();
  }
  if (look == Look::full) {
    if (!partly_hidden || evidence > pooled) pool(evidence, stamp - examined_at_);
    examined_at_ = stamp;
    examined_ = true;
    if (seen_) color_shift_ = followed.color_shift;
  }
  remember(stamp, seen_);
}

void Track::foundAgain(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp) {
  hypothesis_ = found;
  filter_ = PoseFilter(T_reference_model, center_, stamp);
  seen_at_ = std::max(seen_at_, stamp);
  confirmed_ = false;
  examined_ = false;
  searches_ = 1;
  past_.clear();
  remember(stamp, true);
}

void Track::carry(const Eigen::Isometry3d& motion) {
  filter_.carry(motion);
  if (!past_.back().measured) past_.back().T_reference_model = filter_.pose();
}

void Track::carryFromKnown(const Eigen::Isometry3d& motion) {
  carry(motion * known_.T_reference_model * filter_.pose().inverse());
}

void Track::restart(const Eigen::Isometry3d& T_reference_model, double stamp) {
  filter_ = PoseFilter(T_reference_model, center_, stamp);
  elsewhere_.reset();
  past_.clear();
  remember(stamp, true);
}

Eigen::Isometry3d Track::poseAt(double stamp) const {
  const auto later = std::find_if(past_.begin(), past_.end(), [&](const Past& p) { return p.stamp >= stamp; });
  return later == past_.end() ? filter_.pose() : later->T_reference_model;
}

/// Evidence multiplies, so its logarithms are averaged.
void Track::pool(double evidence, double seconds) {
  const double share = 1 - std::exp(-std::max(seconds, 0.0) / pooling);
  const double logarithm = (1 - share) * std::log(std::max(hypothesis_.evidence, smallest_evidence)) +
                           share * std::log(std::max(evidence, smallest_evidence));
  hypothesis_.evidence = std::exp(logarithm);
}

std::optional<Eigen::Isometry3d> Track::measuredAt(double stamp) const {
  const auto same = std::find_if(past_.begin(), past_.end(), [&](const Past& p) { return p.stamp == stamp; });
  if (same == past_.end() || !same->measured) return {};
  return same->T_reference_model;
}

void Track::remember(double stamp, bool measured) {
  past_.push_back({stamp, filter_.pose(), measured});
  if (measured) known_ = past_.back();
  while (past_.front().stamp < stamp - kept_past) past_.pop_front();
}

}  // namespace sks
