// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/pose_filter.hpp"

#include <algorithm>

namespace sks {
namespace {

constexpr int most_averaged = 15;           // poses: jitter falls to a fifth, and light that changes is still followed
constexpr double memory = 0.3;              // share of the newest difference in the mean of the last ones
constexpr double settling = 0.3;            // [s] so long an object has to rest before it stands
constexpr double longest_ahead = 0.1;       // [s] a motion is carried on
constexpr double least_shift = 0.001;       // [m] a shift that matters to nobody
constexpr double moving_turn = 0.0175;      // [rad] 1 degree
constexpr double smoothing = 0.5;           // share of the newest velocity
constexpr double resting_shift_factor = 2;  // rest is looked for with the noise of single poses

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

/// Mean shifts beyond this are a motion: of few poses it is known to about the noise of depth, of which each pose
/// averages many.
double movingShift(double noise) {
  return std::max(least_shift, noise);
}

}  // namespace

PoseFilter::PoseFilter(const Eigen::Isometry3d& T_reference_model, const Eigen::Vector3d& center, double stamp)
    : T_reference_model_(T_reference_model),
      center_(center),
      stamp_(stamp),
      anchor_(T_reference_model),
      anchored_(stamp) {}

Eigen::Vector3d PoseFilter::shift(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
  return to * center_ - from * center_;
}

Eigen::Isometry3d PoseFilter::predicted(double stamp) const {
  if (stands_) return T_reference_model_;
  const double ahead = std::clamp(stamp - stamp_, 0.0, longest_ahead);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotationOf(ahead * turning_) * T_reference_model_.linear();
  pose.translation() = T_reference_model_ * center_ + ahead * velocity_ - pose.linear() * center_;
  return pose;
}

void PoseFilter::update(const Eigen::Isometry3d& measured, double stamp, double noise) {
  const double seconds = stamp - stamp_;
  if (stands_) stand(measured, noise);
  if (!stands_) move(measured, seconds, stamp, noise);
  stamp_ = stamp;
}

void PoseFilter::carry(const Eigen::Isometry3d& motion) {
  T_reference_model_ = motion * T_reference_model_;
  anchor_ = motion * anchor_;
}

void PoseFilter::stand(const Eigen::Isometry3d& measured, double noise) {
  const Eigen::Vector3d apart = shift(T_reference_model_, measured);
  const Eigen::Vector3d turned = rotationVector(measured.linear() * T_reference_model_.linear().transpose());
  drift_ += memory * (apart - drift_);
  turn_ += memory * (turned - turn_);
  if (drift_.norm() > movingShift(noise) || turn_.norm() > moving_turn) {
    stands_ = false;
    velocity_.setZero();
    turning_.setZero();
    return;
  }
  averaged_ = std::min(averaged_ + 1, most_averaged);
  const Eigen::Vector3d center = T_reference_model_ * center_ + apart / averaged_;
  T_reference_model_.linear() =
      Eigen::Quaterniond(rotationOf(turned / averaged_) * T_reference_model_.linear()).normalized().toRotationMatrix();
  T_reference_model_.translation() = center - T_reference_model_.linear() * center_;
}

void PoseFilter::move(const Eigen::Isometry3d& measured, double seconds, double stamp, double noise) {
  if (seconds > 0) {
    const Eigen::Vector3d turned = rotationVector(measured.linear() * T_reference_model_.linear().transpose());
    velocity_ += smoothing * (shift(T_reference_model_, measured) / seconds - velocity_);
    turning_ += smoothing * (turned / seconds - turning_);
  }
  T_reference_model_ = measured;
  const bool rests = shift(anchor_, measured).norm() <= resting_shift_factor * movingShift(noise) &&
                     rotationVector(measured.linear() * anchor_.linear().transpose()).norm() <= 2 * moving_turn;
  if (!rests) {
    anchor_ = measured;
    anchored_ = stamp;
  } else if (stamp - anchored_ >= settling) {
    stands_ = true;
    averaged_ = 1;
    drift_.setZero();
    turn_.setZero();
  }
}

}  // namespace sks
