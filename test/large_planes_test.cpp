// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/large_planes.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "prepared.hpp"
#include "synthetic.hpp"

namespace sks::test {
namespace {

TEST(LargePlanes, FindsTableAndWallWithTheirExtents) {
  const Shape wall{{Solid::Shape::box, {0, 0, 0}, {0.6f, 0.4f, 0.01f}}};
  const Shape table{{Solid::Shape::box, {0, 0, 0}, {0.5f, 0.01f, 0.2f}}};
  const Surface scene = prepared(view({{wall, poseOf(0, {0, 0, 1}, {0, 0, 1.5f})},
                                       {table, poseOf(0, {0, 0, 1}, {0, 0.3f, 1.2f})},
                                       {asymmetricShape(), poseOf(35, {1, 2, 0.5f}, {0, 0.05f, 1.1f})}},
                                      0.0025f, 400, 300));
  const auto planes = findLargePlanes(scene);
  ASSERT_GE(planes.size(), 2u);
  const Eigen::Vector3f to_camera(0, 0, -1), up(0, -1, 0);  // y points down
  EXPECT_NEAR(planeExtentAt(planes, {0.3f, -0.2f, 1.49f}, to_camera), 0.7f, 0.15f);
  EXPECT_NEAR(planeExtentAt(planes, {0.3f, 0.29f, 1.2f}, up), 0.4f, 0.1f);
  EXPECT_EQ(planeExtentAt(planes, {0.3f, 0.29f, 1.2f}, to_camera), 0);  // at the table, but not of it
  // In the air. Faces of the object may be found too, and planes have no end.
  EXPECT_LT(planeExtentAt(planes, {0.3f, 0, 1.0f}, to_camera), 0.1f);
}

TEST(LargePlanes, AreNoLargerThanTheSidesOfThingsThatTheyConsistOf) {
  const Shape side{{Solid::Shape::box, {0, 0, 0}, {0.05f, 0.05f, 0.01f}}};
  const Shape wall{{Solid::Shape::box, {0, 0, 0}, {0.6f, 0.4f, 0.01f}}};
  std::vector<Placed> things{{wall, poseOf(0, {0, 0, 1}, {0, 0, 1.6f})}};
  for (const float x : {-0.2f, 0.0f, 0.2f}) {
    for (const float y : {-0.15f, 0.15f}) things.push_back({side, poseOf(0, {0, 0, 1}, {x, y, 1.0f})});
  }
  const auto planes = findLargePlanes(prepared(view(things, 0.0025f, 400, 300)));
  ASSERT_GE(planes.size(), 2u);
  const Eigen::Vector3f to_camera(0, 0, -1);
  EXPECT_NEAR(planeExtentAt(planes, {0.2f, 0.15f, 0.99f}, to_camera), 0.1f, 0.03f);
  EXPECT_GT(planeExtentAt(planes, {0.4f, 0.2f, 1.59f}, to_camera), 0.5f);
}

TEST(LargePlanes, OfRoundThingsAreSmall) {
  for (const LargePlane& plane : findLargePlanes(prepared(sphere(0.15f, 0.004f, {0, 0, 1})))) {
    EXPECT_LT(plane.extent, 0.15f);
  }
}

TEST(LargePlanes, OfPointsThatAreThereTwiceAreTheSame) {
  SanitizeSettings keeps_all;
  keeps_all.remove_duplicates = false;
  const Cloud once = plane(0.4f, 0.004f);
  const Surface scene = prepareSurface(sanitize(merged({once, once}), keeps_all), {}, Orientation::sensor, 1);
  const auto planes = findLargePlanes(scene);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_NEAR(planes[0].extent, 0.4f, 0.05f);
}

TEST(LargePlanes, OfTinyScenesAreNone) {
  EXPECT_TRUE(findLargePlanes(prepared(plane(0.03f, 0.005f))).empty());
}

TEST(LargePlanes, KeypointsOffThemStay) {
  const LargePlane table{{0, -1, 0}, -0.3f, 0.8f};
  Keypoints keypoints;
  keypoints.positions = {{0, 0.3f, 1}, {0, 0.2f, 1}, {0.1f, 0.305f, 1}, {0.2f, 0.3f, 1}};
  keypoints.normals = {{0, -1, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}};  // the last one stands on the table
  keypoints.curvature = {1, 2, 3, 4};
  EXPECT_EQ(keypointsOffPlanes(keypoints, {table}, 0.5f).curvature, (std::vector<float>{2, 4}));
  EXPECT_EQ(keypointsOffPlanes(keypoints, {table}, 0.9f).size(), 4u);  // no larger than the objects
  EXPECT_EQ(keypointsOffPlanes(keypoints, {}, 0.5f).positions, keypoints.positions);
}

TEST(LargePlanes, AreTheSameEachTimeForAnyThreads) {
  const Surface scene = prepared(view({{asymmetricShape(), poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}));
  const auto a = findLargePlanes(scene, 1), b = findLargePlanes(scene, 3);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].normal, b[i].normal);
}

}  // namespace
}  // namespace sks::test
