// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/pose_filter.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace sks {
namespace {

constexpr double frame = 1.0 / 30;  // [s]
constexpr double noise = 0.002;     // [m] of depth

const Eigen::Vector3d center(0.1, 0, 0);

Eigen::Isometry3d at(double x, double angle = 0) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(x, 0, 1) - pose.linear() * center;
  return pose;
}

double shiftOf(const Eigen::Isometry3d& pose, double x) {
  return (pose * center - Eigen::Vector3d(x, 0, 1)).norm();
}

TEST(PoseFilter, WhatStandsJittersLessThanItsMeasurements) {
  std::mt19937 random(1);
  std::normal_distribution<double> error(0, 0.0006);
  PoseFilter filter(at(0), center, 0);
  double largest = 0, largest_measured = 0;
  for (int i = 1; i <= 200; ++i) {
    const double measured = error(random);
    filter.update(at(measured, 10 * error(random)), i * frame, noise);
    if (i < 20) continue;
    largest = std::max(largest, shiftOf(filter.pose(), 0));
    largest_measured = std::max(largest_measured, std::abs(measured));
    EXPECT_TRUE(filter.stands());
  }
  EXPECT_LT(largest, 0.4 * largest_measured);
}

TEST(PoseFilter, WhatIsPushedIsFollowedAndStandsAgain) {
  PoseFilter filter(at(0), center, 0);
  double x = 0, largest = 0;
  for (int i = 1; i <= 60; ++i) {
    if (i > 10 && i <= 40) x += 0.1 * frame;
    filter.update(at(x), i * frame, noise);
    largest = std::max(largest, shiftOf(filter.pose(), x));
    if (i != 35) continue;
    EXPECT_FALSE(filter.stands());
    EXPECT_LT(shiftOf(filter.predicted(36 * frame), x + 0.1 * frame), 0.001);
  }
  EXPECT_LT(largest, 0.007);  // until it is clear that it moves
  EXPECT_TRUE(filter.stands());
  EXPECT_LT(shiftOf(filter.pose(), x), 0.0005);
}

TEST(PoseFilter, ASlowMotionIsNoticedToo) {
  PoseFilter filter(at(0), center, 0);
  double x = 0;
  for (int i = 1; i <= 300; ++i) {
    x += 0.005 * frame;  // half a centimetre in a second
    filter.update(at(x), i * frame, noise);
    EXPECT_LT(shiftOf(filter.pose(), x), 0.005);
  }
}

TEST(PoseFilter, AMotionIsCarriedOnForATenthOfASecond) {
  PoseFilter filter(at(0), center, 0);
  for (int i = 1; i <= 30; ++i) filter.update(at(0.3 * i * frame, 0.5 * i * frame), i * frame, noise);
  const double last = 30 * frame;
  EXPECT_LT(shiftOf(filter.predicted(last + 0.05), 0.3 * (last + 0.05)), 0.001);
  const Eigen::Matrix3d turned =
      filter.predicted(last + 0.05).linear() * at(0, 0.5 * (last + 0.05)).linear().transpose();
  EXPECT_LT(Eigen::AngleAxisd(turned).angle(), 0.005);
  EXPECT_TRUE(filter.predicted(last + 0.1).isApprox(filter.predicted(last + 5)));
  EXPECT_TRUE(filter.predicted(last - 1).isApprox(filter.pose()));
}

}  // namespace
}  // namespace sks
