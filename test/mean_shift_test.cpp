// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/mean_shift.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "synthetic.hpp"

namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Three pairs at +-distance on the axes: by symmetry a maximum at the centre, of density 6 exp(-(d / h)^2 / 2).
void plant(Points& points, const Eigen::Vector3f& center, float distance) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-distance, distance}) points.push_back(center + side * Eigen::Vector3f::Unit(axis));
  }
}

sks::VotingSettings withBandwidth(double bandwidth) {
  sks::VotingSettings settings;
  settings.bandwidth = bandwidth;
  settings.suppression_radius = 2 * bandwidth;
  settings.tolerance = 1e-4 * bandwidth;
  settings.min_votes = 1;
  return settings;
}

/// The maxima of several votes: lone votes, and the two of a pair, all have the same density, so that order decides.
std::vector<sks::Maximum> shared(std::vector<sks::Maximum> maxima) {
  const auto few = [](const sks::Maximum& maximum) { return maximum.density < 2.5; };
  maxima.erase(std::remove_if(maxima.begin(), maxima.end(), few), maxima.end());
  return maxima;
}

/// Two overlapping clouds of votes and scattered ones.
Points clutter() {
  Points points;
  for (const auto& [center, extent, seed] :
       {std::make_tuple(Eigen::Vector3f(0, 0, 1), 0.03f, 1u), std::make_tuple(Eigen::Vector3f(0.1f, 0, 1), 0.04f, 2u),
        std::make_tuple(Eigen::Vector3f(0, 0, 1.2f), 0.4f, 3u)}) {
    for (const auto& p : sks::test::randomCloud(60, extent, seed).points) points.push_back(center + p);
  }
  return points;
}

}  // namespace

TEST(KernelDensity, CountsVotesWithAGaussian) {
  const Points points{{0, 0, 0}, {0.03f, 0, 0}, {0, 0.06f, 0}, {0, 0, 1}};
  EXPECT_NEAR(sks::kernelDensity({0, 0, 0}, points, 0.03), 1 + std::exp(-0.5) + std::exp(-2), 1e-6);
  EXPECT_EQ(sks::kernelDensity({5, 5, 5}, points, 0.03), 0);
}

// Trap 4: the densities are those of the formula, neither damped nor dependent on what else there is.
TEST(MeanShift, FindsTwoPlantedMaximaAndTheirDensities) {
  const double h = 0.03;
  const Eigen::Vector3f a(0.5f, -0.2f, 1), b(-0.3f, 0.1f, 1.4f);
  Points points;
  plant(points, a, 0.01f);
  plant(points, a, 0.015f);
  plant(points, b, 0.012f);
  const auto maxima = sks::findMaxima(points, withBandwidth(h));
  ASSERT_EQ(maxima.size(), 2u);
  const auto density = [&](double d) { return 6 * std::exp(-0.5 * d * d / (h * h)); };
  EXPECT_LT((maxima[0].position - a).norm(), 1e-4f);
  EXPECT_NEAR(maxima[0].density, density(0.01) + density(0.015), 1e-3);
  EXPECT_LT((maxima[1].position - b).norm(), 1e-4f);
  EXPECT_NEAR(maxima[1].density, density(0.012), 1e-3);
  std::vector<std::uint32_t> first(12), second(6);
  std::iota(first.begin(), first.end(), 0u);
  std::iota(second.begin(), second.end(), 12u);
  EXPECT_EQ(maxima[0].votes, first);
  EXPECT_EQ(maxima[1].votes, second);
}

// Trap 4: votes that two maxima share count in full for both.
TEST(MeanShift, SharedVotesAreNotDamped) {
  const double h = 0.03;
  Points points;
  plant(points, {0, 0, 1}, 0.005f);
  plant(points, {0.09f, 0, 1}, 0.005f);
  points.emplace_back(0.045f, 0.0f, 1.0f);  // 1.5 h from both
  const auto maxima = sks::findMaxima(points, withBandwidth(h));
  ASSERT_EQ(maxima.size(), 2u);
  for (const auto& maximum : maxima) {
    double expected = 0;
    for (const auto& p : points) {
      expected += std::exp(-0.5 * (p - maximum.position).cast<double>().squaredNorm() / (h * h));
    }
    EXPECT_NEAR(maximum.density, expected, 1e-3);
    EXPECT_GT(maximum.density, 6.2);
  }
  EXPECT_NEAR(maxima[0].density, maxima[1].density, 1e-3);
}

TEST(MeanShift, EveryMaximumIsStationaryAndItsDensityIsThatOfTheFormula) {
  const Points points = clutter();
  const sks::VotingSettings settings = withBandwidth(0.03);
  const auto maxima = sks::findMaxima(points, settings);
  ASSERT_GT(maxima.size(), 3u);
  for (std::size_t m = 0; m < maxima.size(); ++m) {
    const Eigen::Vector3d x = maxima[m].position.cast<double>();
    double density = 0;
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    std::vector<std::uint32_t> votes;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d difference = points[i].cast<double>() - x;
      const double weight = std::exp(-0.5 * difference.squaredNorm() / (0.03 * 0.03));
      density += weight;
      step += weight * difference;
      if (difference.norm() <= 0.03) votes.push_back(std::uint32_t(i));
    }
    EXPECT_NEAR(maxima[m].density, density, 0.01 * density);  // the kernel is cut where it is next to nothing
    EXPECT_NEAR(maxima[m].density, sks::kernelDensity(maxima[m].position, points, 0.03), 1e-3);
    EXPECT_LT((step / density).norm(), 3e-4);
    EXPECT_EQ(maxima[m].votes, votes);
    EXPECT_LE(maxima[m].density, maxima[m > 0 ? m - 1 : 0].density);
    for (std::size_t k = 0; k < m; ++k) {
      EXPECT_GE((maxima[m].position - maxima[k].position).norm(), settings.suppression_radius);
    }
  }
}

// Trap 4: a threshold in absolute units would depend on the scale.
TEST(MeanShift, DoesNotDependOnTheScale) {
  const Points points = clutter();
  Points scaled;
  for (const auto& p : points) scaled.push_back(10 * p);
  const auto small = shared(sks::findMaxima(points, withBandwidth(0.03)));
  const auto large = shared(sks::findMaxima(scaled, withBandwidth(0.3)));
  ASSERT_GE(small.size(), 3u);
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t m = 0; m < small.size(); ++m) {
    EXPECT_LT((10 * small[m].position - large[m].position).norm(), 1e-3f);
    EXPECT_NEAR(small[m].density, large[m].density, 1e-3);
    EXPECT_EQ(small[m].votes, large[m].votes);
  }
}

// Trap 4: seeds in cubes can lose a lone vote.
TEST(MeanShift, ALoneVoteIsAMaximum) {
  Points points;
  plant(points, {0, 0, 1}, 0.005f);
  points.emplace_back(2.0f, 1.0f, 1.5f);
  sks::VotingSettings settings = withBandwidth(0.03);
  const auto maxima = sks::findMaxima(points, settings);
  ASSERT_EQ(maxima.size(), 2u);
  EXPECT_EQ(maxima[1].position, points.back());
  EXPECT_NEAR(maxima[1].density, 1, 1e-6);
  EXPECT_EQ(maxima[1].votes, (std::vector<std::uint32_t>{6}));
  settings.min_votes = 2;
  EXPECT_EQ(sks::findMaxima(points, settings).size(), 1u);
  EXPECT_TRUE(sks::findMaxima({}, settings).empty());
}

TEST(MeanShift, DoesNotDependOnTheOrderOfTheVotes) {  // trap 9
  const Points points = clutter();
  const auto expected = shared(sks::findMaxima(points, withBandwidth(0.03)));
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const Points shuffled = sks::test::shuffled(sks::test::makeCloud(points), seed).points;
    const auto maxima = shared(sks::findMaxima(shuffled, withBandwidth(0.03)));
    ASSERT_EQ(maxima.size(), expected.size());
    for (std::size_t m = 0; m < maxima.size(); ++m) {
      EXPECT_LT((maxima[m].position - expected[m].position).norm(), 1e-5f);
      EXPECT_NEAR(maxima[m].density, expected[m].density, 1e-4);
      EXPECT_EQ(maxima[m].votes.size(), expected[m].votes.size());
    }
  }
}

TEST(MeanShift, SuppressesTheWeakerOfTwoNearMaxima) {
  Points points;
  plant(points, {0, 0, 1}, 0.003f);
  plant(points, {0, 0, 1}, 0.004f);
  plant(points, {0.05f, 0, 1}, 0.003f);
  sks::VotingSettings settings = withBandwidth(0.01);
  settings.suppression_radius = 0.03;
  EXPECT_EQ(sks::findMaxima(points, settings).size(), 2u);
  settings.suppression_radius = 0.06;
  const auto maxima = sks::findMaxima(points, settings);
  ASSERT_EQ(maxima.size(), 1u);
  EXPECT_LT(maxima[0].position.head<2>().norm(), 1e-4f);
  settings.suppression_radius = 0;
  EXPECT_EQ(sks::findMaxima(points, settings).size(), 2u);
}

TEST(MeanShift, EqualVotesAreOneMaximum) {
  const auto maxima = sks::findMaxima(Points(25, Eigen::Vector3f(0.1f, 0.2f, 1.3f)), withBandwidth(0.03));
  ASSERT_EQ(maxima.size(), 1u);
  EXPECT_NEAR(maxima[0].density, 25, 1e-3);
  EXPECT_EQ(maxima[0].votes.size(), 25u);
}
