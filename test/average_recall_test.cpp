// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/average_recall.hpp"

#include <gtest/gtest.h>

namespace sks {
namespace {

TEST(AverageRecall, DetectionsTakeTheNearestFreeTargetInTheirOrder) {
  const ErrorTable errors{{0.12, 0.33}, {0.07, 0.90}};
  EXPECT_EQ(foundTargets(errors, 0.05), 0u);
  EXPECT_EQ(foundTargets(errors, 0.10), 1u);  // the second one's
  EXPECT_EQ(foundTargets(errors, 0.50), 1u);  // the first one takes what the second would have
  EXPECT_EQ(foundTargets(errors, 1.00), 2u);
  EXPECT_EQ(foundTargets({{0.9, 0.1}, {0.2, 0.8}}, 1), 2u);
}

TEST(AverageRecall, AnErrorMustBeBelowTheThreshold) {
  EXPECT_EQ(foundTargets({{0.5}}, 0.5), 0u);
  EXPECT_EQ(foundTargets({{0.5}}, 0.51), 1u);
}

TEST(AverageRecall, OnlyAsManyDetectionsAsTargetsCount) {
  EXPECT_EQ(foundTargets({{0.9}, {0.0}}, 0.5), 0u);
  EXPECT_EQ(foundTargets({{0.9, 0.9}, {0.1, 0.9}, {0.1, 0.0}}, 0.5), 1u);
  EXPECT_EQ(foundTargets({}, 0.5), 0u);
}

TEST(AverageRecall, IsTheMeanOverThresholdsOfWhatIsFoundOfAllImages) {
  const std::vector<double> thresholds{0.1, 0.2, 0.3, 0.4};
  RecallCount all = countRecall({{0.15}}, 1, thresholds);           // 0 1 1 1
  all.add(countRecall({}, 1, thresholds));                          // 0 0 0 0
  all.add(countRecall({{0.05, 0.9}, {0.9, 0.35}}, 2, thresholds));  // 1 1 1 2
  EXPECT_EQ(all.targets, 4u);
  EXPECT_EQ(all.found, (std::vector<std::size_t>{1, 2, 2, 3}));
  EXPECT_DOUBLE_EQ(all.average(), (1 + 2 + 2 + 3) / 4.0 / 4);
}

}  // namespace
}  // namespace sks
