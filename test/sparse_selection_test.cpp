// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <sks_detector/stages/keypoints.hpp>

#include "bumps.hpp"
#include "core/keypoints/otsu.hpp"
#include "core/keypoints/sparse_selection.hpp"
#include "synthetic.hpp"

namespace {

sks::Keypoints measured(const sks::Surface& surface, const sks::KeypointSettings& settings = {}, int threads = 1) {
  sks::Keypoints keypoints = sks::gridKeypoints(surface, settings.grid_size);
  sks::measureCurvature(surface, keypoints, settings, {}, threads);
  return keypoints;
}

sks::Surface prepare(const sks::Cloud& cloud) {
  return sks::prepareSurface(cloud, {}, sks::Orientation::sensor, 1);
}

/// The definition, plainly: eigenvalues of the covariance of the normals projected onto the plane across `normal`.
double plainCurvature(const sks::Surface& surface, const Eigen::Vector3f& center, const Eigen::Vector3f& normal,
                      float radius) {
  std::vector<Eigen::Vector3d> projected;
  const Eigen::Vector3d n = normal.cast<double>();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if ((surface.point(i) - center).norm() > radius || !surface.normal(i).allFinite()) continue;
    const Eigen::Vector3d m = surface.normal(i).cast<double>();
    projected.push_back(m - n.dot(m) * n);
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : projected) mean += p / double(projected.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : projected) covariance += (p - mean) * (p - mean).transpose() / double(projected.size());
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return values[2] * values[1];
}

/// Keypoints in a row with these curvatures.
sks::Keypoints withCurvature(const std::vector<float>& curvature) {
  sks::Keypoints keypoints;
  keypoints.curvature = curvature;
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    keypoints.positions.emplace_back(float(i), 0.0f, 0.0f);
    keypoints.normals.emplace_back(0.0f, float(i), 1.0f);
  }
  return keypoints;
}

std::vector<int> keptOf(const std::vector<float>& curvature, const sks::KeypointSettings& settings) {
  std::vector<int> kept;
  for (const auto& p : sks::selectKeypoints(withCurvature(curvature), settings).positions) kept.push_back(int(p.x()));
  return kept;
}

sks::KeypointSettings rank(double discard) {
  sks::KeypointSettings settings;
  settings.discard = discard;
  return settings;
}

}  // namespace

TEST(Curvature, OfAPlaneIsZero) {
  const sks::Keypoints keypoints = measured(prepare(sks::test::plane(0.2f, 0.003f)));
  ASSERT_GT(keypoints.size(), 50u);
  for (const float k : keypoints.curvature) EXPECT_LT(k, 1e-12f);
  for (const auto& n : keypoints.normals) EXPECT_NEAR(std::abs(n.z()), 1, 1e-5);
}

TEST(Curvature, OfASphereFallsWithTheFourthPowerOfItsRadius) {
  // Normals of a cap of radius g on a sphere of radius r spread like (g / r)^2 / 4 along both tangents.
  sks::KeypointSettings settings;
  for (const float r : {0.1f, 0.15f, 0.2f}) {
    sks::Cloud cloud = sks::test::sphere(r, 0.0025f, {0, 0, 1});
    cloud.sensor_origin = {0, 0, 1};
    const sks::Keypoints keypoints = measured(prepare(cloud), settings);
    std::vector<float> curvature = keypoints.curvature;
    std::nth_element(curvature.begin(), curvature.begin() + curvature.size() / 2, curvature.end());
    const double expected = std::pow(settings.grid_size / r, 4) / 16;
    EXPECT_NEAR(curvature[curvature.size() / 2], expected, 0.1 * expected) << "radius " << r;
  }
}

TEST(Curvature, EqualsItsDefinition) {
  const sks::Surface surface = prepare(sks::test::bumps());
  const sks::Keypoints keypoints = measured(surface);
  ASSERT_GT(keypoints.size(), 40u);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const double expected = plainCurvature(surface, keypoints.positions[i], keypoints.normals[i], 0.02f);
    EXPECT_NEAR(keypoints.curvature[i], expected, 1e-4 * expected + 1e-12);
  }
}

// Trap 2: the tangent plane is the keypoint's own, at the centroid, not that of a point of the same index.
TEST(Curvature, NormalIsTheKeypointsOwnWhateverTheOrderOfThePoints) {
  const sks::Cloud cloud = sks::test::bumps();
  const sks::Surface surface = prepare(cloud);
  const sks::Keypoints keypoints = measured(surface);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();  // plane fit at the centroid
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    double count = 0;
    for (const bool second : {false, true}) {
      if (second) mean /= count;
      for (const auto& p : cloud.points) {
        if ((p - keypoints.positions[i]).norm() > 0.01f) continue;
        const Eigen::Vector3d q = p.cast<double>();
        if (second)
          scatter += (q - mean) * (q - mean).transpose();
        else
          mean += q, count += 1;
      }
    }
    if (count < 5) continue;
    const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
    EXPECT_GT(std::abs(normal.dot(keypoints.normals[i].cast<double>())), 0.9999) << i;
  }

  const auto selected = [](const sks::Keypoints& all) {
    std::set<std::tuple<int, int, int>> set;  // in tenths of a millimetre
    for (const auto& p : sks::selectKeypoints(all, rank(0.5)).positions) {
      set.emplace(std::lround(p.x() * 1e4f), std::lround(p.y() * 1e4f), std::lround(p.z() * 1e4f));
    }
    return set;
  };
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    EXPECT_EQ(selected(measured(prepare(sks::test::shuffled(cloud, seed)))), selected(keypoints));
  }
}

TEST(Curvature, DoesNotDependOnThreads) {  // trap 9
  const sks::Surface surface = prepare(sks::test::bumps());
  const sks::Keypoints one = measured(surface, {}, 1);
  for (const int threads : {2, 5}) EXPECT_EQ(measured(surface, {}, threads).curvature, one.curvature);
}

TEST(Curvature, WithoutANormalIsZero) {
  sks::Cloud cloud = sks::test::plane(0.05f, 0.003f);
  cloud.points.emplace_back(1.0f, 1.0f, 1.0f);
  const sks::Keypoints keypoints = measured(prepare(cloud));
  const auto lone = std::find(keypoints.positions.begin(), keypoints.positions.end(), cloud.points.back());
  ASSERT_NE(lone, keypoints.positions.end());
  const auto i = std::size_t(lone - keypoints.positions.begin());
  EXPECT_EQ(keypoints.curvature[i], 0);
  EXPECT_TRUE(std::isnan(keypoints.normals[i].x()));
}

// Trap 1: cutting at a threshold keeps nearly all where over half of the scores tie.
TEST(SparseSelection, RankDropsExactlyTheAskedShareThoughMostScoresTie) {
  for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 10u, 99u, 100u, 101u, 1000u, 6532u}) {
    for (const double discard : {0.0, 0.1, 0.25, 0.3, 0.5, 0.7, 0.75, 0.9, 0.99}) {
      std::vector<float> curvature(n, 0.0f);
      for (std::size_t i = 0; i < n; i += 3) curvature[i] = float(i + 1) * 1e-5f;  // two thirds tie at 0
      const std::size_t dropped = std::size_t(std::floor(discard * double(n) + 1e-9));
      EXPECT_EQ(keptOf(curvature, rank(discard)).size(), n - dropped) << n << " at " << discard;
      EXPECT_EQ(keptOf(std::vector<float>(n, 0.25f), rank(discard)).size(), n - dropped) << n << " at " << discard;
    }
  }
}

TEST(SparseSelection, RankKeepsTheMostCurvedInTheirOrder) {
  EXPECT_EQ(keptOf({5, 1, 4, 2, 3, 0, 9, 7}, rank(0.5)), (std::vector<int>{0, 2, 6, 7}));
  EXPECT_EQ(keptOf({5, 1, 4, 2, 3, 0, 9, 7}, rank(0.75)), (std::vector<int>{6, 7}));
  const sks::Keypoints selected = sks::selectKeypoints(withCurvature({5, 1, 4, 2}), rank(0.5));
  EXPECT_EQ(selected.curvature, (std::vector<float>{5, 4}));
  EXPECT_EQ(selected.normals[1], Eigen::Vector3f(0, 2, 1));
}

// Trap 1: what is kept among ties lies all over the scene.
TEST(SparseSelection, TiesAreKeptEvenlyOverTheScene) {
  std::vector<float> curvature(4000, 0.0f);
  for (std::size_t i = 0; i < 4000; i += 4) curvature[i] = 1;
  const std::vector<int> kept = keptOf(curvature, rank(0.5));
  std::vector<int> tied_in_tenth(10, 0);
  for (const int i : kept) {
    if (curvature[std::size_t(i)] == 0) ++tied_in_tenth[std::size_t(i) / 400];
  }
  for (const int count : tied_in_tenth) EXPECT_NEAR(count, 100, 40);  // 1000 of the 3000 that tie
  EXPECT_EQ(kept, keptOf(curvature, rank(0.5)));
}

TEST(SparseSelection, ThresholdKeepsWhatReachesIt) {
  sks::KeypointSettings settings;
  settings.selection = sks::SelectionRule::threshold;
  settings.curvature_threshold = 0.25;
  EXPECT_EQ(keptOf({0.1f, 0.25f, 0.5f, 0.0f, 0.24f}, settings), (std::vector<int>{1, 2}));
  settings.curvature_threshold = 0;
  EXPECT_EQ(keptOf({0.1f, 0.0f}, settings).size(), 2u);
}

TEST(SparseSelection, HistogramSeparatesFlatFromCurved) {
  std::vector<float> curvature;
  std::vector<int> curved;
  for (int i = 0; i < 600; ++i) {
    const float spread = 1 + 0.002f * float(i * 37 % 600);
    if (i % 3 == 0) curved.push_back(i);
    curvature.push_back((i % 3 == 0 ? 1e-2f : i % 3 == 1 ? 1e-6f : 0.0f) * spread);
  }
  const double threshold = sks::otsuThreshold(curvature);
  EXPECT_GT(threshold, 2.2e-6);
  EXPECT_LE(threshold, 1e-2);
  sks::KeypointSettings settings;
  settings.selection = sks::SelectionRule::histogram;
  EXPECT_EQ(keptOf(curvature, settings), curved);
}

TEST(SparseSelection, HistogramOfEqualValuesKeepsAll) {
  EXPECT_EQ(sks::otsuThreshold({}), 0);
  EXPECT_EQ(sks::otsuThreshold({0, 0, 0}), 0);
  EXPECT_EQ(sks::otsuThreshold({0, 0.5f, 0.5f}), 0);
  sks::KeypointSettings settings;
  settings.selection = sks::SelectionRule::histogram;
  EXPECT_EQ(keptOf({0.5f, 0.5f, 0.5f}, settings).size(), 3u);
}
