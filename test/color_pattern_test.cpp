// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "core/verification/color_pattern.hpp"

namespace sks {
namespace {

constexpr double noise_of_colors = 20;  // units of CIELab

/// Scaled CIELab of a check of 30 and 70 % lightness, red and green.
Eigen::Vector3f checked(bool dark) {
  return dark ? Eigen::Vector3f(0.3f, 0.4f, 0.1f) : Eigen::Vector3f(0.7f, -0.2f, 0.1f);
}

TEST(ColorPattern, ExposureAndWhiteBalanceDoNotMatter) {
  ColorPattern pattern;
  for (int i = 0; i < 64; ++i) {
    const Eigen::Vector3f model = checked(i % 2 == 0);
    pattern.add(model, 0.6f * model + Eigen::Vector3f(-0.15f, 0.05f, 0.1f));
  }
  EXPECT_NEAR(pattern.correlation(), 1, 1e-6);
  EXPECT_EQ(pattern.agreement(noise_of_colors), 1);
}

TEST(ColorPattern, AnotherPatternOfTheSameColorsSpeaksAgainst) {
  ColorPattern other, inverse;
  for (int i = 0; i < 64; ++i) {
    other.add(checked(i % 2 == 0), checked(i / 2 % 2 == 0));  // each pair of colours as often
    inverse.add(checked(i % 2 == 0), checked(i % 2 == 1));
  }
  EXPECT_NEAR(other.correlation(), 0, 1e-6);
  EXPECT_NEAR(inverse.correlation(), -1, 1e-6);
  // Half of each channel's span, (20, 36, 0), is the spread s of the model: expected s / sqrt(2 s^2 + 20^2) = 0.668.
  EXPECT_NEAR(other.agreement(noise_of_colors), 0.3 / (0.668 + 0.3), 1e-3);
  EXPECT_NEAR(inverse.agreement(noise_of_colors), other.agreement(noise_of_colors), 1e-9);
}

TEST(ColorPattern, SaysNothingOfModelsOfOneColor) {
  ColorPattern uniform, faint, none;
  for (int i = 0; i < 64; ++i) {
    uniform.add(Eigen::Vector3f(0.5f, 0, 0), checked(i % 2 == 0));
    faint.add(Eigen::Vector3f(i % 2 == 0 ? 0.51f : 0.5f, 0, 0), checked(i / 2 % 2 == 0));  // 1 % of lightness
  }
  EXPECT_EQ(uniform.agreement(noise_of_colors), 1);
  EXPECT_GT(faint.agreement(noise_of_colors), 0.9);
  EXPECT_EQ(none.agreement(noise_of_colors), 1);
  EXPECT_EQ(none.correlation(), 0);
}

}  // namespace
}  // namespace sks
