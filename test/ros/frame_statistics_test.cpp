// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_statistics.hpp"

#include <gtest/gtest.h>

namespace sks_detector {
namespace {

TEST(FrameStatistics, IsEmptyAtFirst) {
  const FrameStatistics::Summary summary = FrameStatistics().summary();
  EXPECT_EQ(summary.frames, 0U);
  EXPECT_EQ(summary.latency_p50, 0);
  EXPECT_EQ(summary.latency_max, 0);
  EXPECT_EQ(summary.processed + summary.unusable + summary.too_old, 0U);
}

TEST(FrameStatistics, GivesPercentilesOfLatencies) {
  FrameStatistics statistics;
  for (int i = 100; i > 0; --i) statistics.processed(0.01 * i, 0.5 * i);
  const FrameStatistics::Summary summary = statistics.summary();
  EXPECT_EQ(summary.frames, 100U);
  EXPECT_DOUBLE_EQ(summary.latency_p50, 0.5);
  EXPECT_DOUBLE_EQ(summary.latency_p95, 0.95);
  EXPECT_DOUBLE_EQ(summary.latency_max, 1.0);
  EXPECT_DOUBLE_EQ(summary.age, 0.5) << "that of the last";
}

TEST(FrameStatistics, CountsWhatBecameOfClouds) {
  FrameStatistics statistics;
  statistics.processed(0.1, 0.2);
  statistics.unusable();
  statistics.unusable();
  statistics.tooOld(7);
  const FrameStatistics::Summary summary = statistics.summary();
  EXPECT_EQ(summary.processed, 1U);
  EXPECT_EQ(summary.unusable, 2U);
  EXPECT_EQ(summary.too_old, 1U);
  EXPECT_EQ(summary.frames, 1U);
  EXPECT_EQ(summary.age, 7);
}

TEST(FrameStatistics, ForgetsOldLatencies) {
  FrameStatistics statistics;
  statistics.processed(100, 0);
  for (int i = 0; i < 1000; ++i) statistics.processed(1, 0);
  const FrameStatistics::Summary summary = statistics.summary();
  EXPECT_EQ(summary.latency_max, 1);
  EXPECT_LT(summary.frames, 1000U);
  EXPECT_EQ(summary.processed, 1001U);
}

TEST(FrameStatistics, ResetForgetsTimesButNotCounts) {
  FrameStatistics statistics;
  statistics.processed(3, 4);
  statistics.reset();
  const FrameStatistics::Summary summary = statistics.summary();
  EXPECT_EQ(summary.frames, 0U);
  EXPECT_EQ(summary.latency_max, 0);
  EXPECT_EQ(summary.age, 0);
  EXPECT_EQ(summary.processed, 1U);
}

}  // namespace
}  // namespace sks_detector
