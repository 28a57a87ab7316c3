// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/resting_poses.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace sks {
namespace {

using test::Solid;

/// The surface of a solid with normals that point outwards.
ModelSurface surfaceOf(const Solid& solid) {
  ModelSurface surface;
  surface.resolution = 0.004f;
  surface.points = solid.sample(surface.resolution);
  for (const Eigen::Vector3f& p : surface.points) {
    const Eigen::Vector3f q = (p - solid.center).cwiseQuotient(solid.half);
    Eigen::Vector3f normal = q.cwiseQuotient(solid.half);
    if (solid.shape == Solid::Shape::box) {
      int axis = 0;
      q.cwiseAbs().maxCoeff(&axis);
      normal = Eigen::Vector3f::Unit(axis) * (q[axis] > 0 ? 1.0f : -1.0f);
    }
    surface.normals.push_back(normal.normalized());
  }
  return surface;
}

TEST(RestingPoses, ABoxLiesOnEachOfItsSides) {
  const auto poses = restingPoses(surfaceOf({Solid::Shape::box, {0.02f, 0.01f, 0.3f}, {0.05f, 0.03f, 0.01f}}));
  ASSERT_EQ(poses.size(), 6u);
  const float extents[] = {0.1f, 0.06f, 0.02f}, centers[] = {0.02f, 0.01f, 0.3f};
  for (const RestingPose& pose : poses) {
    int axis = 0;
    EXPECT_GT(pose.down.cwiseAbs().maxCoeff(&axis), 0.999f);
    EXPECT_NEAR(pose.height, extents[axis], 0.002);
    const float side = pose.down[axis] > 0 ? 1.0f : -1.0f;
    EXPECT_NEAR(pose.floor, side * centers[axis] + 0.5f * extents[axis], 0.002);
  }
  EXPECT_NEAR(poses[0].height, 0.02, 0.002);  // in which it ends most often
  EXPECT_NEAR(poses[1].height, 0.02, 0.002);
  EXPECT_LT(poses[0].down.dot(poses[1].down), -0.999f);
}

TEST(RestingPoses, ABallRollsAndALensDoesNotStandOnItsEdge) {
  for (const RestingPose& pose : restingPoses(surfaceOf({Solid::Shape::ellipsoid, {0, 0, 0}, {0.03f, 0.03f, 0.03f}}))) {
    EXPECT_NEAR(pose.height, 0.06, 0.002);
  }
  const auto lens = restingPoses(surfaceOf({Solid::Shape::ellipsoid, {0, 0, 0}, {0.05f, 0.05f, 0.01f}}));
  ASSERT_EQ(lens.size(), 2u);
  for (const RestingPose& pose : lens) EXPECT_GT(std::abs(pose.down.z()), 0.98f);
}

TEST(RestingPoses, RollingLeavesRoomForStanding) {
  ModelSurface can;
  can.resolution = 0.004f;
  for (float angle = 0; angle < 6.28f; angle += 0.1f) {
    const Eigen::Vector3f side(std::cos(angle), std::sin(angle), 0);
    for (float z = -0.05f; z < 0.0501f; z += 0.005f) {
      can.points.push_back(0.03f * side + z * Eigen::Vector3f::UnitZ());
      can.normals.push_back(side);
    }
    for (const float radius : {0.01f, 0.02f, 0.029f}) {
      for (const float end : {-1.0f, 1.0f}) {
        can.points.push_back(radius * side + 0.05f * end * Eigen::Vector3f::UnitZ());
        can.normals.push_back(end * Eigen::Vector3f::UnitZ());
      }
    }
  }
  const auto poses = restingPoses(can);
  const auto lies = [](const RestingPose& pose) { return std::abs(pose.down.z()) < 0.05f && pose.height < 0.062f; };
  const auto stands = [](const RestingPose& pose) { return std::abs(pose.down.z()) > 0.999f && pose.height > 0.098f; };
  EXPECT_EQ(std::count_if(poses.begin(), poses.end(), lies), 6);
  EXPECT_EQ(std::count_if(poses.begin(), poses.end(), stands), 2);
  EXPECT_EQ(poses.size(), 8u);
}

TEST(RestingPoses, NothingRestsNowhere) {
  EXPECT_TRUE(restingPoses(ModelSurface()).empty());
}

}  // namespace
}  // namespace sks
