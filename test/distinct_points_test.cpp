// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/distinct_points.hpp"

#include <chrono>
#include <limits>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace sks {
namespace {

using PointList = std::vector<Eigen::Vector3f>;
using IndexList = std::vector<std::uint32_t>;

IndexList allOf(const PointList& points) {
  IndexList indices(points.size());
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

/// The same by a set of positions.
IndexList firstOfEach(const PointList& points, const IndexList& indices) {
  std::set<std::array<float, 3>> seen;
  IndexList kept;
  for (const std::uint32_t i : indices) {
    const Eigen::Vector3f& p = points[i];
    if (seen.insert({p.x(), p.y(), p.z()}).second) kept.push_back(i);
  }
  return kept;
}

/// Whatever the machine has, and within a time that a search of each point among all would take a thousand times over.
void expectDistinct(const PointList& points, const IndexList& indices, const std::string& what) {
  const IndexList wanted = firstOfEach(points, indices);
  for (const int threads : {1, 2, 3, 4, 7, 8, 16}) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(distinctPoints(points, indices, threads), wanted) << what << ", " << threads << " threads";
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20)) << what << ", " << threads;
  }
}

/// `columns` x `rows` points at multiples of `spacing`, those of `repeated` once more.
PointList lattice(int columns, int rows, float spacing, int repeated = 0) {
  PointList points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      points.emplace_back(spacing * float(column), spacing * float(row), 1.0f);
    }
  }
  for (int i = 0; i < repeated; ++i) points.push_back(points[std::size_t(i) * 7919 % std::size_t(columns * rows)]);
  return points;
}

}  // namespace

TEST(DistinctPoints, OnMultiplesOfAPowerOfTwo) {
  for (const int exponent : {-30, -20, -12, -7, -3, 0, 5}) {
    const PointList points = lattice(256, 256, std::ldexp(1.0f, exponent), 1000);
    expectDistinct(points, allOf(points), "2^" + std::to_string(exponent));
  }
}

/// 65,536 of them with 8 threads, 70,000 with 3 and 80,000 with 4 and 7 never came to an end.
TEST(DistinctPoints, OnMultiplesOfAPowerOfTwoOfAnyNumber) {
  for (const int rows : {1, 10, 100, 280, 320, 400}) {
    const PointList points = lattice(250, rows, 1.0f / 128);
    expectDistinct(points, allOf(points), std::to_string(points.size()) + " points");
  }
}

TEST(DistinctPoints, OnALineOrAPlaneOrAllInOnePlace) {
  PointList line, diagonal, powers;
  for (int i = 0; i < 60000; ++i) {
    line.emplace_back(0.0f, 0.0f, 1.0f + float(i % 50000) * 1e-5f);
    diagonal.emplace_back(Eigen::Vector3f::Constant(float(i) / 65536.0f));
    powers.emplace_back(std::ldexp(1.0f, i % 200 - 100), std::ldexp(1.0f, i / 200 % 200 - 100), 1.0f);
  }
  expectDistinct(line, allOf(line), "line");
  expectDistinct(diagonal, allOf(diagonal), "diagonal");
  expectDistinct(powers, allOf(powers), "powers of two");
  const PointList one(100000, Eigen::Vector3f(0.5f, 0, 1));
  expectDistinct(one, allOf(one), "one place");
}

TEST(DistinctPoints, OfTheLeastAndTheGreatestExtent) {
  PointList denormal, huge;
  for (int i = 0; i < 5000; ++i) {
    denormal.emplace_back(float(i % 4000) * std::numeric_limits<float>::denorm_min(), 0.0f, 0.0f);
    huge.emplace_back(float(i % 4000 - 2000) * 1e35f, 1e38f, -1e38f);
  }
  expectDistinct(denormal, allOf(denormal), "denormal");
  expectDistinct(huge, allOf(huge), "huge");
}

TEST(DistinctPoints, KeepTheFirstOfTheIndicesAndTheirOrder) {
  PointList points = test::randomCloud(3000, 0.1f, 8).points;
  for (std::size_t i = 0; i < 3000; i += 3) points.push_back(points[i]);
  IndexList some;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (i % 5 != 0) some.push_back(i);  // also the first of some places
  }
  expectDistinct(points, some, "some of them");
  expectDistinct(points, {}, "none");
  expectDistinct(points, {17}, "one");
}

TEST(DistinctPoints, ZeroHasNoSign) {
  const PointList points{{0.0f, 0, 1}, {-0.0f, 0, 1}, {0, -0.0f, 1}, {0, 0, -1}};
  EXPECT_THAT(distinctPoints(points, allOf(points), 1), testing::ElementsAre(0u, 3u));
}

}  // namespace sks
