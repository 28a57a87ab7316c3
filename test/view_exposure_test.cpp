// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_exposure.hpp"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace sks {
namespace {

const std::vector<Eigen::Array3f> cameras{
    {1.0f, 1.0f, 1.0f}, {1.3f, 1.2f, 1.1f}, {0.7f, 0.8f, 0.75f}, {0.9f, 1.0f, 1.2f}, {1.1f, 1.1f, 0.9f}};

/// A ring of views: each sees half of the places that the next one sees.
std::vector<SeenColor> ringOfViews() {
  std::vector<SeenColor> seen;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> level(40, 180);
  const auto views = std::uint32_t(cameras.size());
  for (std::uint32_t place = 0; place < 40 * views; ++place) {
    const Rgb color{std::uint8_t(level(random)), std::uint8_t(level(random)), std::uint8_t(level(random))};
    const std::uint32_t first = place / 40, second = (first + 1) % views;
    seen.push_back({place, first, exposed(color, cameras[first])});
    seen.push_back({place, second, exposed(color, cameras[second])});
  }
  return seen;
}

TEST(ViewExposure, FactorsUndoWhatEachCameraDid) {
  const std::vector<Eigen::Array3f> factors = exposureFactors(ringOfViews(), cameras.size());
  ASSERT_EQ(factors.size(), cameras.size());
  const Eigen::Array3f first = factors[0] * cameras[0];  // the light itself is not known
  Eigen::Array3f product = Eigen::Array3f::Ones();
  for (std::size_t v = 0; v < cameras.size(); ++v) {
    EXPECT_LT((factors[v] * cameras[v] / first - 1).abs().maxCoeff(), 0.02f) << v;
    product *= factors[v];
  }
  EXPECT_LT((product - 1).abs().maxCoeff(), 0.01f);
}

TEST(ViewExposure, ClippedAndDarkColorsTellNothing) {
  std::vector<SeenColor> seen = ringOfViews();
  const std::vector<Eigen::Array3f> expected = exposureFactors(seen, cameras.size());
  const std::uint32_t place = seen.back().place;
  for (std::uint32_t i = 1; i <= 50; ++i) {
    seen.push_back({place + i, 0, {255, 255, 255}});
    seen.push_back({place + i, 1, {3, 3, 3}});
  }
  const std::vector<Eigen::Array3f> factors = exposureFactors(seen, cameras.size());
  for (std::size_t v = 0; v < cameras.size(); ++v) EXPECT_TRUE((factors[v] == expected[v]).all()) << v;
}

TEST(ViewExposure, ViewsThatShareNothingKeepTheirColors) {
  const std::vector<Eigen::Array3f> factors =
      exposureFactors({{0, 0, {100, 90, 80}}, {0, 0, {90, 90, 80}}, {1, 1, {20, 30, 40}}}, 2);
  for (const Eigen::Array3f& f : factors) EXPECT_TRUE((f == 1).all());
  EXPECT_TRUE(exposureFactors({}, 0).empty());
}

TEST(ViewExposure, ColorsAreClipped) {
  const Rgb color = exposed({200, 100, 0}, {2, 0.5f, 1.5f});
  EXPECT_EQ(color.r, 255);
  EXPECT_EQ(color.g, 50);
  EXPECT_EQ(color.b, 0);
}

}  // namespace
}  // namespace sks
