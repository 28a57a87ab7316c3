// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "points_of.hpp"

namespace sks_detector {
namespace {

using sks::test::pointsOf;

/// A depth image of one distance.
CameraFrame flatFrame(int width, int height, std::uint16_t depth) {
  CameraFrame frame;
  frame.depth.width = width;
  frame.depth.height = height;
  frame.depth.pixels.assign(std::size_t(width * height), depth);
  frame.intrinsics = {500, 400, 0.5 * (width - 1), 0.5 * (height - 1)};
  return frame;
}

TEST(OrganizedCloud, ProjectsPixelsBackThroughThePinhole) {
  CameraFrame frame = flatFrame(4, 2, 2000);
  const auto points = pointsOf(frame);
  ASSERT_EQ(points.size(), 8U);
  EXPECT_FLOAT_EQ(points[0].x, -1.5F / 500 * 2);
  EXPECT_FLOAT_EQ(points[0].y, -0.5F / 400 * 2);
  EXPECT_FLOAT_EQ(points[0].z, 2);
  EXPECT_FLOAT_EQ(points[7].x, 1.5F / 500 * 2);
  EXPECT_FLOAT_EQ(points[7].y, 0.5F / 400 * 2);
}

TEST(OrganizedCloud, IsNanWhereNothingWasMeasured) {
  CameraFrame frame = flatFrame(2, 1, 1000);
  frame.depth.pixels[0] = 0;
  const auto points = pointsOf(frame);
  EXPECT_TRUE(std::isnan(points[0].x) && std::isnan(points[0].y) && std::isnan(points[0].z));
  EXPECT_FLOAT_EQ(points[1].z, 1);
}

TEST(OrganizedCloud, HasNoColourWithoutColourImage) {
  EXPECT_EQ(pointsOf(flatFrame(1, 1, 1000))[0].rgb, 0U);
}

TEST(OrganizedCloud, TakesColoursFromTheSamePixel) {
  CameraFrame frame = flatFrame(2, 1, 1000);
  frame.color = {2, 1, 0, {1, 2, 3, 0xaa, 0xbb, 0xcc}};
  const auto points = pointsOf(frame);
  EXPECT_EQ(points[0].rgb, 0x010203U);
  EXPECT_EQ(points[1].rgb, 0xaabbccU);
}

TEST(OrganizedCloud, TakesColoursInProportionFromALargerImage) {
  CameraFrame frame = flatFrame(2, 1, 1000);
  frame.color = {4, 2, 0, {}};
  for (int pixel = 0; pixel < 8; ++pixel) {
    for (int channel = 0; channel < 3; ++channel) frame.color.pixels.push_back(std::uint8_t(pixel));
  }
  const auto points = pointsOf(frame);
  EXPECT_EQ(points[0].rgb, 0x050505U);
  EXPECT_EQ(points[1].rgb, 0x070707U);
}

TEST(OrganizedCloud, TakesColoursInProportionFromASmallerImage) {
  CameraFrame frame = flatFrame(4, 1, 1000);
  frame.color = {2, 1, 0, {1, 1, 1, 2, 2, 2}};
  const auto points = pointsOf(frame);
  EXPECT_EQ(points[1].rgb, 0x010101U);
  EXPECT_EQ(points[2].rgb, 0x020202U);
}

TEST(Intrinsics, FollowFromTheFieldOfView) {
  const Intrinsics result = intrinsicsFromFieldOfView(640, 480, 2 * std::atan(320 / 525.0), 2 * std::atan(240 / 520.0));
  EXPECT_NEAR(result.fx, 525, 1e-9);
  EXPECT_NEAR(result.fy, 520, 1e-9);
  EXPECT_EQ(result.cx, 319.5);
  EXPECT_EQ(result.cy, 239.5);
}

TEST(Intrinsics, AreTheUsualOnesWithoutFieldOfView) {
  const Intrinsics result = intrinsicsFromFieldOfView(320, 240, 0, 0);
  EXPECT_EQ(result.fx, 262.5);
  EXPECT_EQ(result.fy, 262.5);
}

TEST(Intrinsics, AreOverruledByTheUser) {
  const Intrinsics result = withCalibration({500, 510, 319.5, 239.5}, 600, 0, 230);
  EXPECT_EQ(result.fx, 600);
  EXPECT_EQ(result.fy, 600);
  EXPECT_EQ(result.cx, 319.5);
  EXPECT_EQ(result.cy, 230);
}

}  // namespace
}  // namespace sks_detector
