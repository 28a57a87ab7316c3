// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/keypoints.hpp>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "bumps.hpp"
#include "core/keypoints/iss_keypoints.hpp"
#include "synthetic.hpp"

namespace {

/// Centroids by cell, computed plainly, in the order of the cells.
std::vector<Eigen::Vector3f> bruteForce(const std::vector<Eigen::Vector3f>& points, double edge) {
  std::map<std::tuple<int, int, int>, std::pair<Eigen::Vector3d, int>> cells;
  for (const auto& p : points) {
    const auto cell = [&](int axis) { return int(std::floor(double(p[axis]) / edge)); };
    auto& [sum, count] = cells
                             .emplace(std::make_tuple(cell(2), cell(1), cell(0)),
                                      std::make_pair(Eigen::Vector3d(Eigen::Vector3d::Zero()), 0))
                             .first->second;
    sum += p.cast<double>();
    ++count;
  }
  std::vector<Eigen::Vector3f> centroids;
  for (const auto& [cell, content] : cells) centroids.push_back((content.first / content.second).cast<float>());
  return centroids;
}

void expectNear(const std::vector<Eigen::Vector3f>& a, const std::vector<Eigen::Vector3f>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-6f) << i;
}

}  // namespace

TEST(GridKeypoints, AreTheCentroidsOfTheCells) {
  for (const double edge : {0.02, 0.033, 0.5}) {
    const sks::Cloud cloud = sks::test::randomCloud(3000, 0.15f, 21);  // negative coordinates too
    const sks::Surface surface = sks::makeSurface(cloud, 0.01);
    expectNear(sks::gridKeypoints(surface, edge).positions, bruteForce(cloud.points, edge));
  }
}

TEST(GridKeypoints, GridIsAnchoredAtTheOrigin) {
  // Two points on either side of 0 are in different cells, and a point elsewhere does not move the cells.
  const std::vector<Eigen::Vector3f> pair{{-0.001f, 0.005f, 0.005f}, {0.001f, 0.005f, 0.005f}};
  EXPECT_EQ(sks::gridKeypoints(sks::makeSurface(sks::test::makeCloud(pair), 0.01), 0.02).size(), 2u);
  sks::Cloud more =
      sks::test::makeCloud({{0.001f, 0.005f, 0.005f}, {0.019f, 0.015f, 0.019f}, {-0.513f, -0.217f, 0.3f}});
  const sks::Keypoints keypoints = sks::gridKeypoints(sks::makeSurface(more, 0.01), 0.02);
  ASSERT_EQ(keypoints.size(), 2u);
  EXPECT_LT((keypoints.positions[0] - Eigen::Vector3f(0.01f, 0.01f, 0.012f)).norm(), 1e-6f);
}

TEST(GridKeypoints, DoNotDependOnTheOrderOfThePoints) {
  const sks::Cloud cloud = sks::test::bumps();
  expectNear(sks::gridKeypoints(sks::makeSurface(cloud, 0.01), 0.02).positions,
             sks::gridKeypoints(sks::makeSurface(sks::test::shuffled(cloud, 3), 0.01), 0.02).positions);
}

TEST(GridKeypoints, OfNoPointsAreNone) {
  EXPECT_EQ(sks::gridKeypoints(sks::makeSurface({}, 0.01), 0.02).size(), 0u);
}

TEST(GridKeypoints, AndThinningDoNotDependOnThreads) {
  const sks::Cloud cloud = sks::test::randomCloud(20000, 1, 5);
  const sks::Surface surface = sks::makeSurface(cloud, 0.01);
  const auto once = sks::gridKeypoints(surface, 0.05, 1).positions;
  const auto thinned = sks::thin(cloud, 0.05, 1).points;
  for (const int threads : {2, 3}) {
    EXPECT_EQ(sks::gridKeypoints(surface, 0.05, threads).positions, once);
    EXPECT_EQ(sks::thin(cloud, 0.05, threads).points, thinned);
  }
}

TEST(IssKeypoints, ArePointsOfTheSurfaceAndTheSameForAnyThreads) {  // trap 9
  const sks::Surface surface = sks::makeSurface(sks::test::bumps(), 0.01);
  sks::KeypointSettings settings;
  settings.detector = sks::KeypointDetector::iss;
  const sks::Keypoints one = sks::detectKeypoints(surface, settings, 1);
  EXPECT_GT(one.size(), 5u);
  EXPECT_LT(one.size(), surface.size() / 10);
  std::set<std::tuple<float, float, float>> points;
  for (const auto& p : surface.positions()) points.emplace(p.x(), p.y(), p.z());
  for (const auto& p : one.positions) EXPECT_EQ(points.count({p.x(), p.y(), p.z()}), 1u);
  for (const int threads : {1, 2}) EXPECT_EQ(sks::detectKeypoints(surface, settings, threads).positions, one.positions);
}

TEST(DetectKeypoints, FollowsTheSettings) {
  const sks::Surface surface = sks::makeSurface(sks::test::bumps(), 0.01);
  sks::KeypointSettings settings;
  EXPECT_EQ(sks::detectKeypoints(surface, settings, 1).positions, sks::gridKeypoints(surface, 0.02).positions);
  settings.detector = sks::KeypointDetector::iss;
  EXPECT_EQ(sks::detectKeypoints(surface, settings, 1).positions, sks::issKeypoints(surface, settings, 1).positions);
}
