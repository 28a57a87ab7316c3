// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/color_shift.hpp"

#include <gtest/gtest.h>

namespace sks {
namespace {

Examined seeing(float lightness, double evidence) {
  Examined examined;
  examined.hypothesis.evidence = evidence;
  examined.lines.color_shift = Eigen::Vector3f(lightness, 0.02f, -0.03f);
  return examined;
}

TEST(ColorShift, IsWhatGoodHypothesesHaveInCommon) {
  const Eigen::Vector3f shift =
      sceneColorShift({seeing(-0.14f, 5), seeing(-0.15f, 6), seeing(-0.16f, 7), seeing(0.25f, 3)}, 3.4);
  EXPECT_FLOAT_EQ(shift.x(), -0.15f);
  EXPECT_FLOAT_EQ(shift.y(), 0.02f);
  EXPECT_FLOAT_EQ(shift.z(), -0.03f);
}

TEST(ColorShift, OneHypothesisOfLittleEvidenceDoesNotTell) {
  EXPECT_EQ(sceneColorShift({seeing(-0.2f, 2.5)}, 3.4), Eigen::Vector3f::Zero());
  EXPECT_EQ(sceneColorShift({}, 3.4), Eigen::Vector3f::Zero());
}

TEST(ColorShift, PoorHypothesesHaveNoSay) {
  const std::vector<Examined> poor(50, seeing(-0.2f, 1.6));
  EXPECT_EQ(sceneColorShift(poor, 3.4), Eigen::Vector3f::Zero());
}

TEST(ColorShift, IsBounded) {
  EXPECT_FLOAT_EQ(sceneColorShift({seeing(-0.8f, 9)}, 3.4).x(), -0.3f);
  EXPECT_FLOAT_EQ(sceneColorShift({seeing(0.8f, 9)}, 3.4).x(), 0.3f);
}

TEST(ColorShift, IsZeroWithoutColour) {
  Examined plain;
  plain.hypothesis.evidence = 9;
  EXPECT_EQ(sceneColorShift({plain}, 3.4), Eigen::Vector3f::Zero());
}

}  // namespace
}  // namespace sks
