// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics.hpp"

#include <gtest/gtest.h>

namespace sks {
namespace {

// Five ground truths; hits at ranks 1, 3, 4 of five detections.
const std::vector<RankedDetection> ranking{{0.9, true}, {0.8, false}, {0.7, true}, {0.6, true}, {0.5, false}};

TEST(Metrics, CountsDetectionsAtAndAboveTheThreshold) {
  const Tally tally = tallyAt(ranking, 5, 0.7);
  EXPECT_EQ(tally.true_positives, 2u);
  EXPECT_EQ(tally.false_positives, 1u);
  EXPECT_DOUBLE_EQ(*tally.precision(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(*tally.recall(), 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(*tally.f1(), 0.5);  // 2 * (2/3) * (2/5) / (2/3 + 2/5)
}

TEST(Metrics, IsAbsentWhereUndefined) {
  const Tally nothing_there = tallyAt(ranking, 0, 0.95);
  EXPECT_FALSE(nothing_there.precision());
  EXPECT_FALSE(nothing_there.recall());
  EXPECT_FALSE(nothing_there.f1());
  const Tally only_false = tallyAt({{0.9, false}}, 0, 0);
  EXPECT_EQ(only_false.precision(), 0.0);
  EXPECT_FALSE(only_false.f1());
  const Tally nothing_found = tallyAt({}, 3, 0);
  EXPECT_FALSE(nothing_found.precision());
  EXPECT_EQ(nothing_found.recall(), 0.0);
  EXPECT_EQ(nothing_found.f1(), 0.0);
}

TEST(Metrics, AveragePrecisionIsTheAreaUnderTheInterpolatedCurve) {
  // precision at the hits: 1, 2/3, 3/4; the second is lifted to 3/4 by interpolation; two of five are never found
  const double expected = (1.0 + 0.75 + 0.75) / 5.0;
  EXPECT_DOUBLE_EQ(*averagePrecision(precisionRecallCurve(ranking, 5), 5), expected);
}

TEST(Metrics, AveragePrecisionAtItsEnds) {
  EXPECT_FALSE(averagePrecision({}, 0));
  EXPECT_EQ(averagePrecision({}, 2), 0.0);
  EXPECT_EQ(averagePrecision(precisionRecallCurve({{0.9, true}, {0.8, true}}, 2), 2), 1.0);
}

TEST(Metrics, EqualScoresEnterTheCurveTogetherInAnyOrder) {
  const std::vector<RankedDetection> hit_first{{0.5, true}, {0.5, false}, {0.4, true}};
  const std::vector<RankedDetection> hit_last{{0.4, true}, {0.5, false}, {0.5, true}};
  for (const auto& detections : {hit_first, hit_last}) {
    const std::vector<CurvePoint> curve = precisionRecallCurve(detections, 2);
    ASSERT_EQ(curve.size(), 2u);
    EXPECT_EQ(curve[0].threshold, 0.5);
    EXPECT_EQ(curve[0].tally.precision(), 0.5);
    EXPECT_DOUBLE_EQ(*averagePrecision(curve, 2), 2.0 / 3.0);  // 2/3 at both recalls
  }
}

TEST(Metrics, FindsTheThresholdOfTheHighestF1) {
  const auto best = bestPoint(precisionRecallCurve(ranking, 5));
  ASSERT_TRUE(best);
  EXPECT_EQ(best->threshold, 0.6);
  EXPECT_DOUBLE_EQ(*best->tally.f1(), 6.0 / 9.0);  // 2 * 3 / (4 detections + 5 ground truths)
  EXPECT_FALSE(bestPoint(precisionRecallCurve({{0.9, false}}, 0)));
}

TEST(Metrics, SweepsThresholdsFromZeroToOne) {
  const std::vector<CurvePoint> sweep = thresholdSweep(ranking, 5);
  ASSERT_EQ(sweep.size(), 21u);
  EXPECT_EQ(sweep[0].threshold, 0.0);
  EXPECT_EQ(sweep[0].tally.false_positives, 2u);
  EXPECT_EQ(sweep[14].threshold, 0.7);  // the threshold itself counts
  EXPECT_EQ(sweep[14].tally.true_positives, 2u);
  EXPECT_EQ(sweep[15].tally.true_positives, 1u);
  EXPECT_EQ(sweep[20].threshold, 1.0);
  EXPECT_FALSE(sweep[20].tally.precision());
}

TEST(Metrics, PercentileInterpolatesBetweenRanks) {
  EXPECT_FALSE(percentile({}, 0.5));
  EXPECT_EQ(percentile({7}, 0.95), 7.0);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(*percentile({0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100}, 0.95), 95.0);
  EXPECT_EQ(percentile({1, 2, 3}, 1.0), 3.0);
}

}  // namespace
}  // namespace sks
