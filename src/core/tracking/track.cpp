// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/verification/score.hpp"

namespace sks {
namespace {

constexpr double pooling = 0.3;        // [s] after which a cloud counts a third in the pooled evidence
constexpr double kept_past = 5;        // [s] within which the detection of an earlier cloud has to arrive
constexpr double mostly_hidden = 0.3;  // share of the surface: then little evidence speaks neither way
constexpr double agrees = 0.5;         // least share of what should be seen that the cloud has to confirm
constexpr double least_in_sight =
    0.2;  // share of the surface that faces the sensor without which a pose is not measured
constexpr double lowest_evidence = 0.3;  // of that which scores 0.5: nothing is there
constexpr double least_evidence = 1e-6;  // whose logarithm is taken

}  // namespace

Track::Track(std::uint32_t id, Hypothesis found, const Eigen::Isometry3d& T_reference_model,
             const Eigen::Vector3d& center, double stamp)
    : id_(id),
      hypothesis_(std::move(found)),
      center_(center),
      filter_(T_reference_model, center, stamp),
      begun_(stamp),
      seen_at_(stamp),
      stamp_(stamp) {
  remember(stamp);
}

double Track::score(const Settings& settings) const {
  return scoreOfEvidence(hypothesis_, settings);
}

void Track::update(const FollowedObject& followed, const Eigen::Isometry3d& T_reference_cloud, double stamp,
                   double range, const Settings& settings) {
  const double evidence = followed.hypothesis.evidence;
  const bool partly_hidden = followed.hidden > mostly_hidden, fits = followed.confirmed >= agrees;
  const bool enough = evidence >= lowest_evidence * settings.verification.half_evidence;
  // A part in sight that agrees, however small, says that the object is still there.
  seen_ = fits && (enough || partly_hidden) && 1 - followed.hidden >= least_in_sight;
  hidden_ = !seen_ && partly_hidden;
  const bool speaks = !partly_hidden || evidence > hypothesis_.evidence;
  const double pooled = hypothesis_.evidence, seconds = std::max(0.0, stamp - stamp_);
  if (seen_) {
    hypothesis_ = followed.hypothesis;
    hypothesis_.evidence = pooled;
    filter_.update(T_reference_cloud * followed.hypothesis.T_scene_model, stamp, depthNoise(range));
    seen_at_ = stamp;
    confirmed_ = true;
  }
  if (speaks) pool(evidence, seconds);
  stamp_ = stamp;
  remember(stamp);
}

void Track::foundAgain(const Hypothesis& found, const Eigen::Isometry3d& T_reference_model, double stamp) {
  hypothesis_ = found;
  filter_ = PoseFilter(T_reference_model, center_, stamp);
  seen_at_ = std::max(seen_at_, stamp);
}

void Track::restart(const Eigen::Isometry3d& T_reference_model, double stamp) {
  filter_ = PoseFilter(T_reference_model, center_, stamp);
  past_.clear();
  remember(stamp);
}

Eigen::Isometry3d Track::poseAt(double stamp) const {
  const auto later = std::find_if(past_.begin(), past_.end(), [&](const Past& p) { return p.stamp >= stamp; });
  return later == past_.end() ? filter_.pose() : later->T_reference_model;
}

/// Evidence multiplies, so its logarithms are averaged.
void Track::pool(double evidence, double seconds) {
  const double share = 1 - std::exp(-seconds / pooling);
  const double logarithm = (1 - share) * std::log(std::max(hypothesis_.evidence, least_evidence)) +
                           share * std::log(std::max(evidence, least_evidence));
  hypothesis_.evidence = std::exp(logarithm);
}

void Track::remember(double stamp) {
  past_.push_back({stamp, filter_.pose()});
  while (past_.front().stamp < stamp - kept_past) past_.pop_front();
}

}  // namespace sks
