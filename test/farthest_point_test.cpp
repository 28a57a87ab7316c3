// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/farthest_point.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace sks {
namespace {

TEST(FarthestPoint, IsThatOfAPlainLoop) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal(0, 0.1f);
  const auto any = [&] { return Eigen::Vector3f(normal(random), normal(random), normal(random)); };
  for (const std::size_t size : {1, 2, 15, 16, 17, 33, 500}) {
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < size; ++i) points.push_back(any());
    const FarthestPoint farthest(points);
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3f direction = any().normalized();
      const auto expected = *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return direction.dot(a) < direction.dot(b);
      });
      EXPECT_NEAR(direction.dot(farthest.along(direction)), direction.dot(expected), 1e-6f);
      EXPECT_NE(std::find(points.begin(), points.end(), farthest.along(direction)), points.end());
    }
  }
}

}  // namespace
}  // namespace sks
