// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "ros/camera/frame_pairs.hpp"
#include "ros/camera/video_mode.hpp"

namespace sks_detector {
namespace {

constexpr std::uint64_t period = 33000;  // [us]

DepthImage depthAt(std::uint64_t time) {
  return {1, 1, time, {1}};
}

ColorImage colorAt(std::uint64_t time) {
  return {1, 1, time, {1, 2, 3}};
}

TEST(FramePairs, WaitForTheOtherImageOfTheSameTime) {
  FramePairs pairs(period / 2);
  CameraFrame frame;
  pairs.add(colorAt(1000));
  EXPECT_FALSE(pairs.take(frame));
  pairs.add(depthAt(1000 + period));
  EXPECT_FALSE(pairs.take(frame));
  pairs.add(colorAt(1500 + period));
  ASSERT_TRUE(pairs.take(frame));
  EXPECT_EQ(frame.depth.time, 1000 + period);
  EXPECT_EQ(frame.color.time, 1500 + period);
  EXPECT_FALSE(pairs.take(frame));
}

TEST(FramePairs, DropWhatNoOtherImageCameFor) {
  FramePairs pairs(period / 2);
  CameraFrame frame;
  pairs.add(depthAt(0));
  pairs.add(depthAt(period));
  pairs.add(colorAt(period));
  ASSERT_TRUE(pairs.take(frame));
  EXPECT_EQ(frame.depth.time, period);
  EXPECT_FALSE(pairs.take(frame));
}

TEST(FramePairs, ClocksThatDisagreeCostsOnlySomeDelay) {
  FramePairs pairs(period / 2);
  CameraFrame frame;
  int taken = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    pairs.add(colorAt(1000000000 + i * period));
    pairs.add(depthAt(i * period));
    if (pairs.take(frame)) ++taken;
  }
  EXPECT_EQ(taken, 16);
  EXPECT_EQ(frame.depth.time, 15 * period);
  EXPECT_EQ(frame.color.time, 1000000000 + 19 * period);
}

TEST(FramePairs, StartAgainWhereARecordingDoes) {
  FramePairs pairs(period / 2);
  CameraFrame frame;
  pairs.add(colorAt(100 * period));
  pairs.add(depthAt(101 * period));
  pairs.add(depthAt(0));
  EXPECT_FALSE(pairs.take(frame));
  pairs.add(colorAt(0));
  ASSERT_TRUE(pairs.take(frame));
  EXPECT_EQ(frame.depth.time, 0U);
  EXPECT_EQ(frame.color.time, 0U);
}

TEST(VideoMode, NearestInSizeThenInRate) {
  const std::vector<VideoMode> modes{{320, 240, 30}, {320, 240, 60}, {640, 480, 30}};
  EXPECT_EQ(nearestMode(modes, {640, 480, 60}), 2U);
  EXPECT_EQ(nearestMode(modes, {320, 200, 50}), 1U);
  EXPECT_EQ(nearestMode(modes, {320, 240, 5}), 0U);
  EXPECT_EQ(toText(modes[2]), "640x480 at 30 Hz");
}

}  // namespace
}  // namespace sks_detector
