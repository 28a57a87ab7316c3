// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/surface.hpp>

#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "bumps.hpp"
#include "core/surface/color_space.hpp"
#include "error_of.hpp"
#include "synthetic.hpp"

TEST(Surface, KeepsPointsColorsAndSensorTogether) {
  sks::Cloud cloud = sks::test::bumps(true);
  cloud.sensor_origin = {0.1f, 0.2f, 0.3f};
  const sks::Surface surface = sks::makeSurface(cloud, 0.01);
  ASSERT_EQ(surface.size(), cloud.size());
  EXPECT_EQ(surface.sensor_origin, cloud.sensor_origin);
  ASSERT_TRUE(surface.hasColor());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    EXPECT_EQ(surface.point(i), cloud.points[surface.source[i]]);
    EXPECT_EQ(surface.color[i], sks::toScaledLab(cloud.colors[surface.source[i]]));
  }
  EXPECT_FALSE(sks::makeSurface(sks::test::bumps(), 0.01).hasColor());
}

TEST(Surface, ColorsAreCieLab) {
  const auto expectLab = [](const sks::Rgb& color, float l, float a, float b) {  // published values for D65
    const auto lab = sks::toScaledLab(color);
    const sks::Rgb back = sks::fromScaledLab(lab);
    EXPECT_NEAR(back.r, color.r, 1);
    EXPECT_NEAR(back.g, color.g, 1);
    EXPECT_NEAR(back.b, color.b, 1);
    EXPECT_NEAR(lab[0] * 100, l, 0.1);
    EXPECT_NEAR(lab[1] * 120, a, 0.1);
    EXPECT_NEAR(lab[2] * 120, b, 0.1);
  };
  expectLab({0, 0, 0}, 0, 0, 0);
  expectLab({255, 255, 255}, 100, 0, 0);
  expectLab({128, 128, 128}, 53.59f, 0, 0);
  expectLab({255, 0, 0}, 53.24f, 80.09f, 67.20f);
  expectLab({0, 255, 0}, 87.73f, -86.18f, 83.18f);
  expectLab({0, 0, 255}, 32.30f, 79.19f, -107.86f);
}

TEST(Surface, ThinKeepsOnePointPerCubeNearestToTheCentroid) {
  const double edge = 0.03;
  sks::Cloud cloud = sks::test::randomCloud(2000, 0.1f, 11);
  cloud.colors.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.colors[i] = {std::uint8_t(i % 256), std::uint8_t(i / 256), 0};
  std::map<std::tuple<int, int, int>, std::vector<std::size_t>> cubes;  // in (z, y, x) order
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto cell = [&](int axis) { return int(std::floor(cloud.points[i][axis] / edge)); };
    cubes[{cell(2), cell(1), cell(0)}].push_back(i);
  }
  const sks::Cloud thinned = sks::thin(cloud, edge);
  ASSERT_EQ(thinned.size(), cubes.size());
  ASSERT_EQ(thinned.colors.size(), cubes.size());
  EXPECT_EQ(thinned.width, cubes.size());
  std::size_t row = 0;
  for (const auto& [cube, members] : cubes) {
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const std::size_t i : members) centroid += cloud.points[i].cast<double>() / double(members.size());
    double nearest = 1;
    for (const std::size_t i : members) nearest = std::min(nearest, (cloud.points[i].cast<double>() - centroid).norm());
    EXPECT_NEAR((thinned.points[row].cast<double>() - centroid).norm(), nearest, 1e-6);
    const std::size_t source = thinned.colors[row].r + 256 * thinned.colors[row].g;
    EXPECT_EQ(cloud.points[source], thinned.points[row]);
    ++row;
  }
}

TEST(Surface, PreparingThinsToTheResolution) {
  sks::SurfaceSettings settings;
  settings.resolution = 0.008;
  const sks::Cloud cloud = sks::test::bumps();
  const sks::Surface surface = sks::prepareSurface(cloud, settings, sks::Orientation::sensor, 1);
  EXPECT_EQ(surface.size(), sks::thin(cloud, 0.008).size());
  EXPECT_LT(surface.size(), cloud.size() / 3);
  settings.resolution = 0;
  EXPECT_EQ(sks::prepareSurface(cloud, settings, sks::Orientation::sensor, 1).size(), cloud.size());
}

TEST(Surface, TooFineAGridIsRefusedWithTheCoordinate) {
  const sks::Cloud cloud = sks::test::makeCloud({{0, 0, 0}, {2000, 0, 0}});
  const std::string message = sks::test::errorOf(sks::ErrorCode::bad_data, [&] { sks::thin(cloud, 0.001); });
  EXPECT_EQ(message, "a coordinate of 2000.000000 m is too far from the origin for a grid of 0.001000 m");
}
