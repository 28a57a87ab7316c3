// SPDX-License-Identifier: BSD-3-Clause
// MSSD and MSPD against values that follow from the geometry, and the symmetries that they take into account.
#include "evaluation/surface_distance.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "plate.hpp"

namespace sks {
namespace {

using test::at;

/// Half sizes of 0.08, 0.06 and 0.1 m: its vertices are 0.1 m away from the z axis.
ObjectModel boxModel() {
  ObjectModel model;
  for (int i = 0; i < 8; ++i) model.points.emplace_back(i & 1 ? 0.08 : -0.08, i & 2 ? 0.06 : -0.06, i & 4 ? 0.1 : -0.1);
  model.diameter = diameterOf(model.points);
  return model;
}

Eigen::Isometry3d turnedBy(double degrees, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ()) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(degrees * EIGEN_PI / 180, axis));
}

const Eigen::Isometry3d somewhere = at(0.1, -0.2, 0.9) * turnedBy(40, Eigen::Vector3d(1, 2, 3).normalized());

TEST(SurfaceDistance, OfATranslationIsItsLength) {
  const Eigen::Vector3d way(0.02, -0.03, 0.06);  // 0.07 m
  EXPECT_NEAR(surfaceDistance(boxModel(), Eigen::Translation3d(way) * somewhere, somewhere), 0.07, 1e-12);
  EXPECT_NEAR(surfaceDistance(boxModel(), somewhere, somewhere), 0, 1e-12);
}

TEST(SurfaceDistance, OfARotationIsThatOfTheFarthestVertex) {
  for (const double degrees : {5.0, 60.0, 90.0, 180.0}) {
    const double expected = 2 * 0.1 * std::sin(degrees / 2 * EIGEN_PI / 180);
    EXPECT_NEAR(surfaceDistance(boxModel(), somewhere * turnedBy(degrees), somewhere), expected, 1e-12) << degrees;
  }
}

TEST(SurfaceDistance, TakesTheNearestOfAllPosesThatLookTheSame) {
  ObjectModel box = boxModel();
  box.symmetries = symmetryMotions(listedSymmetries({Eigen::Vector3d::UnitZ(), 2}, Eigen::Vector3d::Zero()));
  EXPECT_NEAR(surfaceDistance(box, somewhere * turnedBy(180), somewhere), 0, 1e-12);
  EXPECT_NEAR(surfaceDistance(box, somewhere * turnedBy(170), somewhere), 2 * 0.1 * std::sin(5 * EIGEN_PI / 180),
              1e-12);
  EXPECT_GT(surfaceDistance(box, somewhere * turnedBy(180, Eigen::Vector3d::UnitX()), somewhere), 0.19);
}

TEST(SurfaceDistance, BodiesOfRevolutionMayStandBetweenTwoSteps) {
  ObjectModel box = boxModel();
  box.symmetries = symmetryMotions(listedSymmetries({Eigen::Vector3d::UnitZ(), 0}, Eigen::Vector3d::Zero()));
  const double half_step = EIGEN_PI / double(box.symmetries.size());
  for (const double degrees : {37.0, 123.4, 300.0}) {
    EXPECT_LE(surfaceDistance(box, somewhere * turnedBy(degrees), somewhere),
              2 * 0.1 * std::sin(half_step / 2) + 1e-12);
  }
}

TEST(SurfaceDistance, AnAxisNeedNotGoThroughTheOrigin) {
  ObjectModel box = boxModel();
  for (Eigen::Vector3d& point : box.points) point.x() += 0.5;
  const Eigen::Isometry3d half_turn = at(0.5, 0, 0) * turnedBy(180) * at(-0.5, 0, 0);
  EXPECT_GT(surfaceDistance(box, somewhere * half_turn, somewhere), 0.19);
  box.symmetries = symmetryMotions(listedSymmetries({Eigen::Vector3d::UnitZ(), 2}, Eigen::Vector3d(0.5, 0, 0)));
  EXPECT_NEAR(surfaceDistance(box, somewhere * half_turn, somewhere), 0, 1e-12);
  ObjectSymmetries listed;
  listed.continuous.push_back({Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0.5, 0, 7)});
  box.symmetries = symmetryMotions(listed);
  EXPECT_LE(surfaceDistance(box, somewhere * half_turn, somewhere), 0.001);
}

TEST(SurfaceDistance, DiscreteSymmetriesAreCombinedWithThoseAboutAnAxis) {
  ObjectSymmetries listed;
  listed.continuous.push_back({});
  listed.discrete.push_back(turnedBy(180, Eigen::Vector3d::UnitX()));
  ObjectModel box = boxModel();
  box.symmetries = symmetryMotions(listed);
  EXPECT_EQ(box.symmetries.size(), 2 * 315u);  // steps of at most 1 % of the diameter: pi / 0.01
  EXPECT_TRUE(box.symmetries[0].isApprox(Eigen::Isometry3d::Identity()));
  const Eigen::Isometry3d both = turnedBy(77) * turnedBy(180, Eigen::Vector3d::UnitX());
  EXPECT_LE(surfaceDistance(box, somewhere * both, somewhere), 0.001);
  EXPECT_EQ(symmetryMotions({}).size(), 1u);
}

TEST(ProjectionDistance, OfALateralShiftIsFocalLengthTimesShiftOverDepth) {
  const SceneCamera camera{640, 480, 500, 520, 320, 240};
  const ObjectModel plate = test::plate();
  EXPECT_NEAR(projectionDistance(plate, camera, at(0.03, 0, 2), at(0, 0, 2)), 500 * 0.03 / 2, 1e-9);
  EXPECT_NEAR(projectionDistance(plate, camera, at(0, 0.03, 2), at(0, 0, 2)), 520 * 0.03 / 2, 1e-9);
  // along the ray: the farthest vertex is 0.105 m from the axis, both ways
  EXPECT_NEAR(projectionDistance(plate, camera, at(0, 0, 2.5), at(0, 0, 2)),
              0.105 * std::hypot(500, 520) * (1 / 2.0 - 1 / 2.5), 1e-9);
}

TEST(ProjectionDistance, TakesTheNearestOfAllPosesThatLookTheSame) {
  ObjectModel plate = test::plate();
  const Eigen::Vector3d center(0.005, 0.005, 0);
  const Eigen::Isometry3d quarter = Eigen::Translation3d(center) * turnedBy(90) * Eigen::Translation3d(-center);
  EXPECT_NEAR(projectionDistance(plate, test::plateCamera(), at(0, 0, 1) * quarter, at(0, 0, 1)), 20, 1e-9);
  plate.symmetries = symmetryMotions(listedSymmetries({Eigen::Vector3d::UnitZ(), 4}, center));
  EXPECT_NEAR(projectionDistance(plate, test::plateCamera(), at(0, 0, 1) * quarter, at(0, 0, 1)), 0, 1e-9);
}

TEST(ProjectionDistance, BehindTheCameraNothingIsSeen) {
  EXPECT_TRUE(std::isinf(projectionDistance(test::plate(), test::plateCamera(), at(0, 0, -1), at(0, 0, 1))));
  EXPECT_TRUE(std::isinf(projectionDistance(test::plate(), test::plateCamera(), at(0, 0, 1), at(0, 0, -1))));
}

TEST(Diameter, IsTheGreatestDistanceOfTwoPoints) {
  EXPECT_NEAR(boxModel().diameter, std::sqrt(0.16 * 0.16 + 0.12 * 0.12 + 0.2 * 0.2), 1e-12);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points;  // on an ellipsoid
  for (int i = 0; i < 500; ++i) {
    points.push_back(Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized());
    points.back().z() *= 1.1;
  }
  double greatest = 0;
  for (const Eigen::Vector3d& a : points) {
    for (const Eigen::Vector3d& b : points) greatest = std::max(greatest, (a - b).norm());
  }
  EXPECT_LE(diameterOf(points), greatest);
  EXPECT_GE(diameterOf(points), 0.999 * greatest);
  EXPECT_EQ(diameterOf({}), 0);
}

}  // namespace
}  // namespace sks
