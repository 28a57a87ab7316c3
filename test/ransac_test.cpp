// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/ransac.hpp"

#include <gtest/gtest.h>

#include <sks_detector/stages/hypothesis.hpp>

#include "synthetic.hpp"

namespace {

using ClosePoints = std::vector<Eigen::Vector3d>;

ClosePoints randomPoints(std::size_t count, double extent, std::uint32_t seed) {
  ClosePoints points;
  for (const auto& p : sks::test::randomCloud(count, float(extent), seed).points) points.push_back(p.cast<double>());
  return points;
}

ClosePoints moved(const ClosePoints& points, const Eigen::Isometry3d& T) {
  ClosePoints result;
  for (const auto& p : points) result.push_back(T * p);
  return result;
}

Eigen::Isometry3d poseOf(double degrees, const Eigen::Vector3d& axis, const Eigen::Vector3d& translation) {
  return Eigen::Translation3d(translation) * Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized());
}

/// Every fifth and fourth of five pairs fit, the others miss by 0.2 m and more.
void spoil(ClosePoints& to) {
  const ClosePoints noise = randomPoints(to.size(), 1, 99);
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (i % 5 < 3) to[i] += noise[i] + 0.2 * noise[i].normalized();
  }
}

double error(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

}  // namespace

// Trap 5: the rotation itself, not its inverse, for many poses.
TEST(FitRigid, FindsTheMotionOfAllPairs) {
  const ClosePoints from = randomPoints(20, 0.2, 1);
  for (int i = 0; i <= 12; ++i) {
    const Eigen::Isometry3d T = poseOf(15.0 * i, {1, -0.5 * i, 2}, {0.1 * i, -1, 3});
    EXPECT_LT(error(sks::fitRigid(from, moved(from, T)), T), 1e-9) << 15 * i << " degrees";
  }
}

TEST(FitRigid, OfPlanarPointsIsNoReflection) {
  ClosePoints from = randomPoints(12, 0.2, 2);
  for (auto& p : from) p.z() = 0.5;
  const Eigen::Isometry3d T = poseOf(170, {0, 1, 0.2}, {0.3, 0, 1});
  const Eigen::Isometry3d found = sks::fitRigid(from, moved(from, T));
  EXPECT_NEAR(found.linear().determinant(), 1, 1e-9);
  EXPECT_LT(error(found, T), 1e-9);
  const ClosePoints three(from.begin(), from.begin() + 3);
  EXPECT_LT(error(sks::fitRigid(three, moved(three, T)), T), 1e-9);
}

TEST(FitRigid, SpreadsErrorsEvenly) {
  const ClosePoints from{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  ClosePoints to = from;
  to[0].x() += 0.1;
  to[1].x() += 0.1;
  to[2].x() -= 0.1;
  to[3].x() -= 0.1;
  EXPECT_LT(error(sks::fitRigid(from, to), Eigen::Isometry3d::Identity()), 1e-9);
}

// Trap 6: RANSAC's motion is the pose, and the identity is a valid one.
TEST(Ransac, FindsAPlantedPoseAmongSixtyPercentOutliers) {
  for (const std::size_t n : {10u, 25u, 100u}) {
    for (const auto& T : {poseOf(0, {0, 0, 1}, {0, 0, 0}), poseOf(140, {2, 1, -1}, {0.4, -0.3, 1.2})}) {
      const ClosePoints from = randomPoints(n, 0.2, 3);
      ClosePoints to = moved(from, T);
      spoil(to);
      const sks::RigidConsensus found = sks::rigidRansac(from, to, {});
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < n; ++i) {
        if (i % 5 >= 3) expected.push_back(i);
      }
      EXPECT_EQ(found.inliers, expected);
      EXPECT_LT(error(found.T_to_from, T), 1e-6);
    }
  }
}

TEST(Ransac, FitsAllInliersWithinTheThreshold) {
  const ClosePoints from = randomPoints(50, 0.2, 4), noise = randomPoints(50, 0.005, 5);
  const Eigen::Isometry3d T = poseOf(60, {1, 1, 1}, {0, 0.2, 1});
  ClosePoints to = moved(from, T);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += noise[i];
  const sks::RigidConsensus found = sks::rigidRansac(from, to, {});
  EXPECT_EQ(found.inliers.size(), 50u);
  EXPECT_LT(error(found.T_to_from, sks::fitRigid(from, to)), 1e-12);
  EXPECT_LT((found.T_to_from.translation() - T.translation()).norm(), 0.003);
}

TEST(Ransac, WithoutAgreementHasNoInliers) {
  const ClosePoints from = randomPoints(4, 0.2, 6);
  EXPECT_TRUE(sks::rigidRansac(from, randomPoints(4, 5, 7), {}).inliers.empty());
  EXPECT_TRUE(sks::rigidRansac({from[0], from[1]}, {from[0], from[1]}, {}).inliers.empty());
  EXPECT_TRUE(sks::rigidRansac({}, {}, {}).inliers.empty());
}

TEST(Ransac, SameSeedSameResult) {  // trap 9
  const ClosePoints from = randomPoints(200, 0.2, 8);
  ClosePoints to = moved(from, poseOf(20, {0, 1, 0}, {0, 0, 1}));
  const ClosePoints noise = randomPoints(200, 0.06, 9);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += noise[i];
  const sks::RigidConsensus first = sks::rigidRansac(from, to, {}), second = sks::rigidRansac(from, to, {});
  EXPECT_GT(first.inliers.size(), 3u);
  EXPECT_EQ(first.inliers, second.inliers);
  EXPECT_EQ(first.T_to_from.matrix(), second.T_to_from.matrix());
}
