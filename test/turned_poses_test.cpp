// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/turned_poses.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace sks {
namespace {

const Eigen::Isometry3d T_scene_book = test::poseOf(40, {1, 2, 3}, {0.1f, 0.2f, 0.9f}).cast<double>();
const Eigen::Vector3d book_center(0.03, -0.02, 0.05);

TEST(TurnedPoses, HalfTurnsKeepTheBoxOfThreeEdges) {
  const auto poses = turnedPoses(T_scene_book, book_center, {0.2, 0.15, 0.03}, std::nullopt);
  ASSERT_EQ(poses.size(), 3u);
  for (const Eigen::Isometry3d& T : poses) {
    EXPECT_NEAR((T * book_center - T_scene_book * book_center).norm(), 0, 1e-6);
    EXPECT_NEAR(test::angleDegrees(T.linear(), T_scene_book.linear()), 180, 1e-4);
    for (int axis = 0; axis < 3; ++axis) {  // each edge lies along the same line as before
      EXPECT_NEAR(std::abs(T.linear().col(axis).dot(T_scene_book.linear().col(axis))), 1, 1e-6);
    }
  }
}

TEST(TurnedPoses, AllAroundWhereTheBoxIsSquare) {
  const auto poses = turnedPoses(T_scene_book, book_center, {0.1, 0.1, 0.2}, std::nullopt);
  ASSERT_EQ(poses.size(), 13u);  // half turns about x and y; eleven of 30 to 330 degrees about z
  int quarters = 0;
  for (const Eigen::Isometry3d& T : poses) {
    quarters += std::abs(test::angleDegrees(T.linear(), T_scene_book.linear()) - 90) < 1e-4;
  }
  EXPECT_EQ(quarters, 2);
  double least = 360;
  for (const Eigen::Isometry3d& T : poses) {
    least = std::min(least, test::angleDegrees(T.linear(), T_scene_book.linear()));
  }
  EXPECT_NEAR(least, 30, 1e-4);
  EXPECT_EQ(turnedPoses(T_scene_book, book_center, {0.1, 0.1, 0.1}, std::nullopt).size(), 33u);
}

TEST(TurnedPoses, AboutTheAxisOfTheBodyOfAMug) {
  const BodyAxis body{2, {0.02, -0.02, 0}};
  const auto poses = turnedPoses(T_scene_book, book_center, {0.12, 0.08, 0.1}, body);
  ASSERT_EQ(poses.size(), 25u);  // half turns about x and y; 23 of 15 to 345 degrees about the body
  int about_body = 0;
  for (const Eigen::Isometry3d& T : poses) {
    about_body += (T * body.origin - T_scene_book * body.origin).norm() < 1e-6 &&
                  (T.linear().col(2) - T_scene_book.linear().col(2)).norm() < 1e-6;
  }
  EXPECT_EQ(about_body, 23);
}

}  // namespace
}  // namespace sks
