// SPDX-License-Identifier: BSD-3-Clause
#include "core/score.hpp"

#include <gtest/gtest.h>

namespace {

double scoreOf(double density, double half_density = 8) {
  sks::Hypothesis hypothesis;
  hypothesis.density = density;
  sks::DetectionSettings settings;
  settings.half_density = half_density;
  return sks::score(hypothesis, settings);
}

}  // namespace

TEST(Score, GrowsFromZeroBelowOne) {
  EXPECT_EQ(scoreOf(0), 0);
  double previous = 0;
  for (const double density : {0.1, 1.0, 3.0, 8.0, 20.0, 100.0, 1e4, 1e6}) {
    EXPECT_GT(scoreOf(density), previous);
    previous = scoreOf(density);
    EXPECT_LT(previous, 1);
  }
}

TEST(Score, IsOneHalfAtTheHalfDensity) {
  for (const double half : {0.5, 8.0, 120.0}) EXPECT_DOUBLE_EQ(scoreOf(half, half), 0.5);
}
