// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/view_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sks {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A coloured image of a plane at z = 1, `spacing` from pixel to pixel; NaN in a margin of 3 pixels on the left.
Cloud image(float spacing, std::uint32_t width = 64, std::uint32_t height = 48) {
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const float x = column < 3 ? std::numeric_limits<float>::quiet_NaN() : spacing * float(column);
      cloud.points.emplace_back(x, spacing * float(row), 1.0f);
    }
  }
  cloud.colors.resize(cloud.points.size());
  return cloud;
}

std::vector<std::uint32_t> window(const Cloud& cloud, std::uint32_t left, std::uint32_t top, std::uint32_t width,
                                  std::uint32_t height) {
  std::vector<std::uint32_t> points;
  for (std::uint32_t row = top; row < top + height; ++row) {
    for (std::uint32_t column = left; column < left + width; ++column) points.push_back(row * cloud.width + column);
  }
  return points;
}

TEST(ViewQuality, MeasuresAGoodView) {
  const Cloud cloud = image(0.002f);
  const ViewQuality quality = assessView(cloud, window(cloud, 10, 10, 31, 26), Settings());
  EXPECT_EQ(quality.points, 31u * 26u);
  EXPECT_NEAR(quality.extent.x(), 0.06, 1e-6);
  EXPECT_NEAR(quality.extent.y(), 0.05, 1e-6);
  EXPECT_NEAR(quality.spacing, 0.002, 1e-6);
  EXPECT_THAT(quality.remarks, IsEmpty());
}

TEST(ViewQuality, RemarksOnTheBordersOfWhatWasMeasured) {
  const Cloud cloud = image(0.002f);
  const auto cut_off = Contains(HasSubstr("cut off by the border"));
  for (const auto& points : {window(cloud, 4, 10, 30, 30), window(cloud, 33, 10, 30, 30), window(cloud, 10, 1, 30, 30),
                             window(cloud, 10, 17, 30, 30)}) {
    EXPECT_THAT(assessView(cloud, points, Settings()).remarks, cut_off);
  }
}

TEST(ViewQuality, ObjectsMayStandOutFromAllElse) {
  Cloud cloud = image(0.002f);
  const auto points = window(cloud, 10, 5, 30, 30);
  for (std::size_t i = 0; i < 20 * cloud.width; ++i) {  // nothing but the object in the upper rows
    if (std::find(points.begin(), points.end(), i) == points.end()) cloud.points[i].x() = NAN;
  }
  EXPECT_THAT(assessView(cloud, points, Settings()).remarks, IsEmpty());
}

TEST(ViewQuality, RemarksOnFewAndCoarsePoints) {
  const Cloud cloud = image(0.006f);
  EXPECT_THAT(assessView(cloud, window(cloud, 20, 20, 12, 12), Settings()).remarks,
              ElementsAre(HasSubstr("only 144 points"),
                          HasSubstr("the points are 6.0 mm apart, but surface.normal_radius (10.0 mm) needs 4.0 mm")));
}

TEST(ViewQuality, RemarksOnSmallAndColourlessObjects) {
  Cloud cloud = image(0.001f);
  cloud.colors.clear();
  EXPECT_THAT(assessView(cloud, window(cloud, 10, 10, 30, 30), Settings()).remarks,
              ElementsAre(HasSubstr("descriptor.radius (50.0 mm)"), HasSubstr("without colour")));
}

TEST(ViewQuality, RemarksOnCloudsThatAreNotInTheCamerasFrame) {
  Cloud cloud = image(0.002f);
  for (auto& p : cloud.points) p.z() = -0.2f;
  const auto points = window(cloud, 10, 10, 31, 26);
  EXPECT_THAT(assessView(cloud, points, Settings()).remarks, ElementsAre(HasSubstr("~sensor_frame")));
  cloud.sensor_origin = {0, 0, 1};
  EXPECT_THAT(assessView(cloud, points, Settings()).remarks, IsEmpty());
}

}  // namespace
}  // namespace sks
