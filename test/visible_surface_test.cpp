// SPDX-License-Identifier: BSD-3-Clause
// VSD against counted pixels, and the depth pictures that it compares.
#include "evaluation/visible_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "evaluation/depth_rendering.hpp"
#include "plate.hpp"

namespace sks {
namespace {

using test::at;
using test::plate;
using test::plateCamera;

std::size_t pixelOf(int column, int row) {
  return std::size_t(row * plateCamera().width + column);
}

DepthMap drawn(const Eigen::Isometry3d& pose) {
  return renderDepth(plate(), pose, plateCamera());
}

/// A scene in which the same depth was measured everywhere; 0: nothing.
SceneDepth sceneAt(float depth) {
  return {plateCamera(), DepthMap(std::size_t(plateCamera().width * plateCamera().height), depth)};
}

/// A surface half a metre away in the columns 51 to 60, before a wall at 2 m.
SceneDepth occluded() {
  SceneDepth scene = sceneAt(2);
  for (int row = 0; row < scene.camera.height; ++row) {
    for (int column = 51; column <= 60; ++column) scene.depth[pixelOf(column, row)] = 0.5f;
  }
  return scene;
}

double vsd(const Eigen::Isometry3d& found, const Eigen::Isometry3d& truth, const SceneDepth& scene,
           double tolerance = 0.05) {
  return visibleSurfaceDiscrepancy(drawn(found), drawn(truth), scene, {tolerance}).at(0);
}

TEST(RenderDepth, CoversThePixelsWhoseCentresAreInside) {
  const DepthMap depth = drawn(at(0, 0, 1));
  for (int row = 0; row < plateCamera().height; ++row) {
    for (int column = 0; column < plateCamera().width; ++column) {
      const bool inside = column >= 41 && column <= 60 && row >= 31 && row <= 50;
      EXPECT_EQ(depth[pixelOf(column, row)], inside ? 1.0f : 0.0f) << column << " " << row;
    }
  }
}

TEST(RenderDepth, GivesTheDepthOfASlantedSurface) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 0.5, 0).normalized();
  const Eigen::Isometry3d pose = at(0.02, 0.01, 0.8) * Eigen::AngleAxisd(1, axis);
  const DepthMap depth = drawn(pose);
  const Eigen::Vector3d normal = pose.linear().col(2);
  std::size_t covered = 0;
  for (int row = 0; row < plateCamera().height; ++row) {
    for (int column = 0; column < plateCamera().width; ++column) {
      if (depth[pixelOf(column, row)] == 0) continue;
      ++covered;
      const Eigen::Vector3d ray((column - 50) / 100.0, (row - 40) / 100.0, 1);
      EXPECT_NEAR(depth[pixelOf(column, row)], normal.dot(pose.translation()) / normal.dot(ray), 1e-6);
    }
  }
  EXPECT_GT(covered, 250u);
  EXPECT_LT(covered, 450u);
}

TEST(RenderDepth, TheNearestSurfaceIsSeenWhateverTheOrder) {
  ObjectModel two = plate();
  for (std::size_t i = 0; i < 4; ++i) two.points.push_back(two.points[i] - Eigen::Vector3d(0, 0, 0.25));
  two.triangles.insert(two.triangles.end(), {{4, 5, 6}, {5, 7, 6}});
  EXPECT_EQ(renderDepth(two, at(0, 0, 1), plateCamera())[pixelOf(50, 40)], 0.75f);
  std::reverse(two.triangles.begin(), two.triangles.end());
  EXPECT_EQ(renderDepth(two, at(0, 0, 1), plateCamera())[pixelOf(50, 40)], 0.75f);
}

TEST(RenderDepth, NothingIsSeenOutsideThePictureAndBehindTheCamera) {
  for (const Eigen::Isometry3d& pose : {at(0, 0, -1), at(0, 0, 0), at(5, 0, 1), at(0, -5, 1), at(1e6, 1e6, 0.01)}) {
    const DepthMap depth = drawn(pose);
    EXPECT_EQ(std::count(depth.begin(), depth.end(), 0.0f), 100 * 80);
  }
  const DepthMap cut = drawn(at(0.45, 0, 1));  // columns 86 to 105
  EXPECT_EQ(std::count(cut.begin(), cut.end(), 1.0f), 14 * 20);
}

TEST(VisibleSurface, ShiftedByHalfItsWidthTwoThirdsDiffer) {
  // 20 columns each, 10 in common: 20 of 30 are covered by one of them alone
  for (const SceneDepth& scene : {sceneAt(0), sceneAt(2), sceneAt(1)}) {
    EXPECT_DOUBLE_EQ(vsd(at(0.1, 0, 1), at(0, 0, 1), scene), 2.0 / 3);
    EXPECT_DOUBLE_EQ(vsd(at(0, 0.1, 1), at(0, 0, 1), scene), 2.0 / 3);
  }
  EXPECT_EQ(vsd(at(0, 0, 1), at(0, 0, 1), sceneAt(2)), 0);
  EXPECT_EQ(vsd(at(0.3, 0, 1), at(0, 0, 1), sceneAt(2)), 1);
}

TEST(VisibleSurface, AlongTheRayTheToleranceDecides) {
  // at 1.04 m the same pixels are covered; rays are up to 2 % longer than their depth
  EXPECT_EQ(vsd(at(0, 0, 1.04), at(0, 0, 1), sceneAt(2), 0.045), 0);
  EXPECT_EQ(vsd(at(0, 0, 1.04), at(0, 0, 1), sceneAt(2), 0.035), 1);
  // where the true pose is visible the found one is, although the measured surface lies before it
  EXPECT_EQ(vsd(at(0, 0, 1.04), at(0, 0, 1), sceneAt(1), 0.045), 0);
  const std::vector<double> both =
      visibleSurfaceDiscrepancy(drawn(at(0, 0, 1.04)), drawn(at(0, 0, 1)), sceneAt(2), {0.02, 0.03, 0.05, 0.1});
  EXPECT_EQ(both, (std::vector<double>{1, 1, 0, 0}));
}

TEST(VisibleSurface, DistancesAreAlongTheRay) {
  // far from the centre of the picture: ray lengths from 1.024 (column 72) to 1.17 at 1.04 m minus 1 m
  const Eigen::Isometry3d near = at(-0.4, -0.3, 1), far = at(-0.4 * 1.04, -0.3 * 1.04, 1.04);
  EXPECT_EQ(vsd(far, near, sceneAt(2), 0.041), 1);
  EXPECT_EQ(vsd(far, near, sceneAt(2), 0.051), 0);
}

TEST(VisibleSurface, WhatIsOccludedDoesNotCount) {
  EXPECT_EQ(vsd(at(0, 0, 1), at(0, 0, 1), occluded()), 0);
  // true 41 to 50, found 61 to 70
  EXPECT_EQ(vsd(at(0.1, 0, 1), at(0, 0, 1), occluded()), 1);
  // true 41 to 50, found 46 to 50 and 61 to 65: 5 of 15 columns in common, without the occluder 15 of 25
  EXPECT_DOUBLE_EQ(vsd(at(0.05, 0, 1), at(0, 0, 1), occluded()), 10.0 / 15);
  EXPECT_DOUBLE_EQ(vsd(at(0.05, 0, 1), at(0, 0, 1), sceneAt(2)), 10.0 / 25);
}

TEST(VisibleSurface, SurfacesOf15MillimetresBeforeItDoNotOcclude) {
  EXPECT_EQ(vsd(at(0, 0, 1), at(0, 0, 1), sceneAt(0.99f)), 0);
  EXPECT_EQ(vsd(at(0, 0, 1), at(0, 0, 1), sceneAt(0.98f)), 1);  // nothing is visible
}

TEST(SceneDepth, FindsTheCameraOfAnOrganisedCloud) {
  const SceneCamera camera{64, 48, 60, 55, 31.5, 22.25};
  Cloud cloud;
  cloud.width = 64;
  cloud.height = 48;
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 64; ++column) {
      const double z = 1 + 0.01 * ((7 * column + 3 * row) % 50);
      cloud.points.emplace_back(float(z * (column - camera.cx) / camera.fx), float(z * (row - camera.cy) / camera.fy),
                                float(z));
    }
  }
  cloud.points[100].setConstant(std::numeric_limits<float>::quiet_NaN());
  cloud.points[200].setZero();
  const auto scene = sceneDepth(cloud, 1);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->camera.width, 64);
  EXPECT_EQ(scene->camera.height, 48);
  EXPECT_NEAR(scene->camera.fx, 60, 1e-3);
  EXPECT_NEAR(scene->camera.fy, 55, 1e-3);
  EXPECT_NEAR(scene->camera.cx, 31.5, 1e-3);
  EXPECT_NEAR(scene->camera.cy, 22.25, 1e-3);
  EXPECT_EQ(scene->depth[100], 0);
  EXPECT_EQ(scene->depth[200], 0);
  EXPECT_EQ(scene->depth[300], cloud.points[300].z());
  EXPECT_NEAR(scene->camera.rayLength(61, 22), std::hypot(1, 29.5 / 60), 1e-4);

  Cloud bent = cloud;
  bent.points[1000].x() += 0.05f;
  EXPECT_FALSE(sceneDepth(bent, 1));
  cloud.width = std::uint32_t(cloud.size());
  cloud.height = 1;
  EXPECT_FALSE(sceneDepth(cloud, 1));
}

}  // namespace
}  // namespace sks
