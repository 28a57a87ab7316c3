// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sequence_gaps.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace sks_detector {
namespace {

class SequenceGapsTest : public ::testing::Test {
protected:
  /// Messages come at 10 Hz.
  std::uint32_t lost(const std::string& publisher, std::uint32_t number, double seconds = 0.1) {
    now_ += std::chrono::duration_cast<SequenceGaps::Clock::duration>(std::chrono::duration<double>(seconds));
    return gaps_.lostBefore(publisher, number, now_);
  }
  std::uint32_t lostOf(const std::vector<std::uint32_t>& numbers) {
    std::uint32_t sum = 0;
    for (const std::uint32_t number : numbers) sum += lost("camera", number);
    return sum;
  }

  SequenceGaps gaps_;
  SequenceGaps::Clock::time_point now_;
};

TEST_F(SequenceGapsTest, CountWhatDidNotCome) {
  EXPECT_EQ(lostOf({7, 8, 9, 10}), 0u);
  EXPECT_EQ(lost("camera", 14), 3u);
  EXPECT_EQ(lost("camera", 15), 0u);
  EXPECT_EQ(lost("camera", 1500), 0u) << "more than any camera sends in that time";
  EXPECT_EQ(lostOf({1501, 1502}), 0u);
  EXPECT_EQ(lost("camera", 1532, 3.0), 29u);
  EXPECT_EQ(lost("camera", 1534, 0.0001), 1u);
}

TEST_F(SequenceGapsTest, WhatWasHeldUpComesAllAtOnce) {
  lostOf({1, 2, 3});
  EXPECT_EQ(lost("camera", 4, 3.0), 0u) << "the first one after a pause of the receiver";
  EXPECT_EQ(lost("camera", 28, 0.001), 23u);
  EXPECT_EQ(lost("camera", 31, 0.001), 2u);
}

TEST_F(SequenceGapsTest, KeepPublishersApart) {
  EXPECT_EQ(lost("left", 1) + lost("right", 1000) + lost("left", 2) + lost("right", 1001), 0u);
  EXPECT_EQ(lost("left", 5), 2u);
  EXPECT_EQ(lost("right", 1002), 0u);
}

TEST_F(SequenceGapsTest, NumbersThatGoBackOrStandStillTellNothing) {
  EXPECT_EQ(lostOf({100, 101, 102, 0, 1, 2}), 0u) << "a new start";
  EXPECT_EQ(lostOf({2, 3, 4, 2, 3, 4, 5}), 0u) << "a bag that is played again";
  EXPECT_EQ(lostOf({0, 0, 0, 0}), 0u) << "no numbers";
  EXPECT_EQ(lostOf({1, 4000000000u, 17, 3000000000u, 90000, 5}), 0u) << "numbers at random";
  EXPECT_EQ(lostOf({100, 5, 101, 6, 102, 7}), 0u) << "two cameras behind one relay";
  const std::uint32_t largest = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(lostOf({largest - 1, largest, 0, 1}), 0u);
  EXPECT_EQ(lostOf({largest - 1, largest, 2}), 2u);
}

TEST_F(SequenceGapsTest, TheSmallestStepIsOneMessage) {
  EXPECT_EQ(lostOf({3, 6, 9, 12}), 0u) << "behind a throttle";
  EXPECT_EQ(lost("camera", 15), 0u);
  EXPECT_EQ(lost("camera", 24), 2u);
  EXPECT_EQ(lost("camera", 28), 0u);
}

TEST_F(SequenceGapsTest, WhatComesAfterAPauseIsNotMissed) {
  lostOf({1, 2, 3});
  gaps_.clear();
  EXPECT_EQ(lostOf({50, 51}), 0u);
}

TEST_F(SequenceGapsTest, AnyNumberOfPublishersTakesNoMoreMemory) {
  for (int i = 0; i < 100000; ++i) EXPECT_EQ(lost("play_" + std::to_string(i), 7), 0u);
  EXPECT_EQ(lost("camera", 1) + lost("camera", 2), 0u);
  EXPECT_EQ(lost("camera", 4), 1u);
}

}  // namespace
}  // namespace sks_detector
