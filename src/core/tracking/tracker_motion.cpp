// SPDX-License-Identifier: BSD-3-Clause
// How the camera moves where no frame is known in which things stand still.
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "core/tracking/tracker_state.hpp"

namespace sks {
namespace {

constexpr double same_motion = 0.01;    // [m] by which centres may be off that move alike
constexpr std::ptrdiff_t agreeing = 2;  // objects by which the motion of the camera is known: one may be moved itself
constexpr double longest_step = 0.1;    // [s] the camera's motion is carried on

/// A small motion that goes on for `times` as long.
Eigen::Isometry3d carriedOn(const Eigen::Isometry3d& motion, double times) {
  const Eigen::AngleAxisd turn(motion.linear());
  Eigen::Isometry3d on = Eigen::Isometry3d::Identity();
  on.linear() = Eigen::AngleAxisd(times * turn.angle(), turn.axis()).toRotationMatrix();
  on.translation() = times * motion.translation();
  return on;
}

}  // namespace

/// Where no frame is known in which things stand still: how most of what is seen has moved in the frame of the cloud
/// since an earlier cloud, for the camera has moved. Only what was measured in both clouds tells; none: fewer than
/// `least_alike` objects agree.
std::optional<Eigen::Isometry3d> Tracker::State::motionSince(double then, std::ptrdiff_t least_alike) const {
  std::optional<Eigen::Isometry3d> common;
  if (fixed) return Eigen::Isometry3d::Identity();
  struct Moved {
    Eigen::Isometry3d motion;
    Eigen::Vector3d from, to;
  };
  std::vector<Moved> telling;
  for (const Track& track : tracks) {
    const std::optional<Eigen::Isometry3d> before = track.measuredAt(then);
    if (!before || !track.seen() || !track.confirmed()) continue;
    const Eigen::Isometry3d& now = track.filter().pose();
    telling.push_back({now * before->inverse(), *before * track.center(), now * track.center()});
  }
  std::ptrdiff_t most = least_alike;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Moved& one : telling) {
    std::ptrdiff_t alike = 0;
    double apart = 0;
    for (const Moved& other : telling) {
      const double off = (one.motion * other.from - other.to).norm();
      if (off >= same_motion) continue;
      ++alike;
      apart += off;
    }
    if (alike < most || (alike == most && apart >= nearest)) continue;
    most = alike;
    nearest = apart;
    common = one.motion;
  }
  return common;
}

/// The same since the cloud that was searched. One object alone may have been moved, or have a turn that cannot be
/// told, so the scene as a whole is asked before it.
Eigen::Isometry3d Tracker::State::motionSinceSearched(double then) const {
  if (const auto told = motionSince(then, agreeing)) return *told;
  if (const auto shown = scene_motion.since(then, settings())) return *shown;
  return motionSince(then).value_or(Eigen::Isometry3d::Identity());
}

/// What is not seen has moved as all else since it was last seen, or, where nothing tells of that, since the last
/// cloud.
void Tracker::State::carryUnseen(double last) {
  if (fixed) return;
  const Eigen::Isometry3d motion = motionSince(last).value_or(Eigen::Isometry3d::Identity());
  for (Track& track : tracks) {
    if (track.seen()) continue;
    if (const auto since = motionSince(track.knownAt())) {
      track.carryFromKnown(*since);
    } else {
      track.carry(motion);
    }
  }
}

/// How what stands moves in the frame of the cloud until the next one, if the camera goes on as it did between the last
/// two.
std::optional<Eigen::Isometry3d> Tracker::State::stepTo(double next) const {
  if (fixed || !last_step || last_step_took <= 0) return {};
  return carriedOn(*last_step, std::min(next - last_stamp, longest_step) / last_step_took);
}

/// Keeps the motion since the last cloud for stepTo().
void Tracker::State::keepStep(double last) {
  last_step = fixed ? std::nullopt : motionSince(last, agreeing);
  last_step_took = stamp - last;
  last_stamp = stamp;
}

}  // namespace sks
