// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/point_grid.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace {

using GridPoints = std::vector<Eigen::Vector3f>;

/// Indices into the original points, ascending.
std::vector<std::uint32_t> neighbors(const sks::PointGrid& grid, const Eigen::Vector3f& center, float radius) {
  std::vector<sks::PointGrid::Run> runs;
  std::vector<std::uint32_t> found;
  std::uint32_t previous = 0;
  grid.forEachNeighbor(center, radius, runs, [&](std::uint32_t i, float squared) {
    EXPECT_TRUE(found.empty() || i > previous) << "not in order of the index";
    EXPECT_NEAR(squared, (grid.point(i) - center).squaredNorm(), 1e-5f * radius * radius);
    previous = i;
    found.push_back(grid.source[i]);
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> bruteForce(const GridPoints& points, const Eigen::Vector3f& center, float radius) {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float dx = points[i].x() - center.x(), dy = points[i].y() - center.y(), dz = points[i].z() - center.z();
    if (dx * dx + dy * dy + dz * dz <= radius * radius) found.push_back(std::uint32_t(i));
  }
  return found;
}

void expectSameNeighbors(const GridPoints& points, double cell, const GridPoints& centers, float radius) {
  const sks::PointGrid grid(points, cell);
  ASSERT_EQ(grid.size(), points.size());
  for (const auto& center : centers) {
    EXPECT_EQ(neighbors(grid, center, radius), bruteForce(points, center, radius))
        << "cell " << cell << ", radius " << radius << ", center " << center.transpose();
  }
}

}  // namespace

struct PointGridCase {
  double cell;
  float radius;
};

class PointGridNeighbors : public testing::TestWithParam<PointGridCase> {};

TEST_P(PointGridNeighbors, EqualBruteForce) {
  const GridPoints points = sks::test::randomCloud(3000, 0.2f, 3).points;
  GridPoints centers = sks::test::randomCloud(60, 0.25f, 4).points;
  centers.insert(centers.end(), points.begin(), points.begin() + 40);
  expectSameNeighbors(points, GetParam().cell, centers, GetParam().radius);
}

INSTANTIATE_TEST_SUITE_P(CellsAndRadii, PointGridNeighbors,
                         testing::Values(PointGridCase{0.01, 0.01f}, PointGridCase{0.01, 0.05f},
                                         PointGridCase{0.05, 0.01f}, PointGridCase{0.003, 0.02f},
                                         PointGridCase{1.0, 0.03f}, PointGridCase{0.02, 1.0f},
                                         PointGridCase{0.0175, 0.0241f}));

TEST(PointGrid, PointsAtTheRimAreNeighbors) {
  GridPoints points;
  for (int i = -8; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k) points.emplace_back(0.0f, float(i) * 0.125f, float(k) * 0.125f);
  }
  for (const float radius : {0.125f, 0.25f, 0.375f}) {  // exact in binary: the rim itself
    expectSameNeighbors(points, 0.125, points, radius);
    expectSameNeighbors(points, 0.1, points, radius);
  }
}

TEST(PointGrid, OutliersFarAwayLoseNothing) {
  GridPoints points = sks::test::randomCloud(2000, 0.1f, 5).points;
  for (const Eigen::Vector3f& far :
       {Eigen::Vector3f(15, 15, 15), Eigen::Vector3f(-15, -15, 15), Eigen::Vector3f(0, 400, -400)}) {
    points.push_back(far);
  }
  GridPoints centers(points.end() - 30, points.end());
  expectSameNeighbors(points, 0.001, centers, 0.05f);
  expectSameNeighbors(points, 0.001, {{1e6f, 0, 0}, {0, -1e6f, 0}, {0, 0, 1e6f}}, 0.05f);
}

TEST(PointGrid, OnePointAndNone) {
  const GridPoints one{{0.3f, -0.2f, 1.5f}};
  expectSameNeighbors(one, 0.01, {one[0], {0.3f, -0.2f, 1.51f}, {0, 0, 0}}, 0.02f);
  const sks::PointGrid empty(GridPoints{}, 0.01);
  EXPECT_EQ(empty.size(), 0u);
  EXPECT_TRUE(neighbors(empty, Eigen::Vector3f::Zero(), 1).empty());
  EXPECT_TRUE(neighbors(sks::PointGrid(), Eigen::Vector3f::Zero(), 1).empty());
}

TEST(PointGrid, IdenticalPointsAreAllFoundInTheirOrder) {
  const GridPoints same(50, Eigen::Vector3f(1, 2, 3));
  expectSameNeighbors(same, 0.01, {same[0]}, 0.001f);
  const sks::PointGrid grid(same, 0.01);
  for (std::uint32_t i = 0; i < 50; ++i) EXPECT_EQ(grid.source[i], i);
}

TEST(PointGrid, WithoutACellHasTheSameNeighbors) {
  const GridPoints points{{0, 0, 0}, {0, 0.1f, 0.2f}, {0.3f, 0, 0.2f}, {0.31f, 0, 0.2f}};
  expectSameNeighbors(points, 0, points, 0.05f);
}

/// Places at which sizes, buckets or rows may overflow, or in which all points share one of them.
TEST(PointGrid, StandsAnyPlacesForAnyNumberOfThreads) {
  std::vector<GridPoints> clouds(6);
  for (int i = 0; i < 3000; ++i) {
    clouds[0].emplace_back(float(i % 60) / 128, float(i / 60) / 128, 1.0f);              // dyadic
    clouds[1].emplace_back(0.0f, 0.0f, float(i * 7 % 3000) / 4096);                      // on a line, in no order
    clouds[2].emplace_back(std::ldexp(1.0f, i % 160 - 140), 0.0f, 0.0f);                 // powers of two
    clouds[3].emplace_back(float(i % 50) * 1e-44f, float(i % 7) * 1e-44f, 0.0f);         // denormal
    clouds[4].emplace_back(float(i % 50) - 25, float(i % 60) - 30, i < 9 ? 400.0f : 0);  // wide
    clouds[5].emplace_back(0.5f, -0.5f, 1.0f);                                           // one place
  }
  for (const GridPoints& points : clouds) {
    for (const double cell : {1e-4, 0.01, 10.0}) {
      const sks::PointGrid one(points, cell, 1);
      ASSERT_EQ(one.size(), points.size());
      for (const int threads : {2, 3, 8, 16}) EXPECT_EQ(sks::PointGrid(points, cell, threads).source, one.source);
      for (const float radius : {1e-3f, 0.1f}) {
        for (const std::size_t i : {0u, 1u, 1499u, 2999u}) {
          EXPECT_EQ(neighbors(one, points[i], radius), bruteForce(points, points[i], radius)) << cell << " " << radius;
        }
      }
    }
  }
}

TEST(PointGrid, IsAPermutationPaddedWithInfinity) {
  const GridPoints points = sks::test::randomCloud(500, 0.2f, 6).points;
  const sks::PointGrid grid(points, 0.02);
  std::vector<char> seen(points.size(), 0);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(grid.point(i), points[grid.source[i]]);
    seen[grid.source[i]] = 1;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 500);
  EXPECT_EQ(grid.positions().size(), points.size());
  for (const auto* axis : {&grid.x, &grid.y, &grid.z}) {
    ASSERT_EQ(axis->size(), points.size() + sks::PointGrid::simd_padding);
    for (std::size_t i = points.size(); i < axis->size(); ++i) {
      EXPECT_EQ((*axis)[i], std::numeric_limits<float>::infinity());
    }
  }
}
