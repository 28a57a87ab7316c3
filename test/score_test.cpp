// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/score.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace {

double scoreOfDensity(double density, double half_density = 8) {
  sks::Hypothesis hypothesis;
  hypothesis.density = density;
  sks::Settings settings;
  settings.detection.half_density = half_density;
  return sks::scoreOfDensity(hypothesis, settings);
}

double scoreOfVotes(double evidence, std::size_t words, double half_density = 8) {
  sks::Hypothesis hypothesis;
  hypothesis.evidence = evidence;
  sks::Settings settings;
  settings.detection.half_density = half_density;
  return sks::scoreOfVotes(hypothesis, words, settings);
}

double scoreOfEvidence(double evidence, double half_evidence) {
  sks::Hypothesis hypothesis;
  hypothesis.evidence = evidence;
  sks::Settings settings;
  settings.verification.half_evidence = half_evidence;
  return sks::scoreOfEvidence(hypothesis, settings);
}

}  // namespace

TEST(Score, GrowsFromZeroBelowOne) {
  EXPECT_EQ(scoreOfDensity(0), 0);
  EXPECT_EQ(scoreOfEvidence(0, 3), 0);
  double by_density = 0, by_evidence = 0;
  for (const double value : {0.1, 1.0, 3.0, 8.0, 20.0, 50.0}) {  // evidence above that does not occur
    EXPECT_GT(scoreOfDensity(value), by_density);
    EXPECT_GT(scoreOfEvidence(value, 3), by_evidence);
    by_density = scoreOfDensity(value);
    by_evidence = scoreOfEvidence(value, 3);
    EXPECT_LT(by_density, 1);
    EXPECT_LT(by_evidence, 1);
  }
}

TEST(Score, IsOneHalfAtTheHalfDensityAndEvidence) {
  for (const double half : {0.5, 8.0, 120.0}) {
    EXPECT_DOUBLE_EQ(scoreOfDensity(half, half), 0.5);
    EXPECT_DOUBLE_EQ(scoreOfEvidence(half, half), 0.5);
  }
}

TEST(Score, OfVotesIsAShareOfWhatTheViewOffers) {
  EXPECT_EQ(scoreOfVotes(0, 270), 0);
  EXPECT_DOUBLE_EQ(scoreOfVotes(8, 270), 0.5);
  EXPECT_DOUBLE_EQ(scoreOfVotes(24, 270), 0.75);
  EXPECT_DOUBLE_EQ(scoreOfVotes(5, 270, 5), 0.5);
  EXPECT_NEAR(scoreOfVotes(8 * std::pow(0.25, 0.6), 270 / 4 + 1, 8), 0.5, 0.002);  // a quarter: 3.5 votes
  EXPECT_GT(scoreOfVotes(6, 50), scoreOfVotes(6, 300));
  EXPECT_LT(scoreOfVotes(1000, 1), 1);
  EXPECT_GT(scoreOfVotes(1, 0), 0);  // a codebook that was not made by training
}
