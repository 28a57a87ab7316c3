// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/lowest_bounds.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>

namespace sks::test {
namespace {

std::vector<float> randomBounds(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> bound(0.1f, 4.0f);
  std::vector<float> bounds(count);
  for (float& b : bounds) b = bound(random);
  return bounds;
}

/// Adds what is wanted of `bounds`, some at a time, with slots from 1000 on.
void addInParts(const std::vector<float>& bounds, LowestBounds& lowest) {
  constexpr std::size_t part = 100;
  for (std::size_t first = 0; first < bounds.size(); first += part) {
    std::vector<std::uint32_t> selected;
    for (std::uint32_t i = 0; i < part; ++i) {
      if (bounds[first + i] <= lowest.highest()) selected.push_back(i);
    }
    lowest.add(std::uint32_t(1000 + first), &bounds[first], selected.data(), selected.size());
  }
  lowest.finish();
}

TEST(LowestBounds, KeepsTheWantedOnesAndFewMore) {
  std::vector<float> bounds = randomBounds(5000);
  LowestBounds lowest;
  lowest.begin(200, 1.0f);
  addInParts(bounds, lowest);
  ASSERT_EQ(lowest.slots.size(), lowest.bounds.size());
  for (std::size_t i = 0; i < lowest.slots.size(); ++i) EXPECT_EQ(lowest.bounds[i], bounds[lowest.slots[i] - 1000]);
  std::vector<float> sorted = bounds;
  std::sort(sorted.begin(), sorted.end());
  std::sort(lowest.bounds.begin(), lowest.bounds.end());
  ASSERT_GE(lowest.bounds.size(), 200u);
  EXPECT_LE(lowest.bounds.size(), 240u);  // a step of 3 % of the bounds more
  EXPECT_TRUE(std::equal(lowest.bounds.begin(), lowest.bounds.end(), sorted.begin()));
}

TEST(LowestBounds, KeepsAllWhereAllOrMoreThanThereAreAreWanted) {
  const std::vector<float> bounds = randomBounds(300);
  for (const std::size_t wanted : {0, 300, 1000}) {
    LowestBounds lowest;
    lowest.begin(wanted, 1.0f);
    addInParts(bounds, lowest);
    EXPECT_EQ(lowest.bounds.size(), 300u) << wanted;
  }
}

TEST(LowestBounds, BoundsFarFromUsualOnesAreKeptToo) {
  for (const float factor : {1e-9f, 1e9f}) {
    std::vector<float> bounds = randomBounds(300);
    for (float& bound : bounds) bound *= factor;
    LowestBounds lowest;
    lowest.begin(50, 1.0f);
    addInParts(bounds, lowest);
    EXPECT_GE(lowest.bounds.size(), 50u) << factor;
    EXPECT_THAT(lowest.bounds, testing::Contains(*std::min_element(bounds.begin(), bounds.end())));
  }
}

TEST(LowestBounds, NegativeBoundsAreLow) {
  std::vector<float> bounds(300, 1.0f);
  bounds[250] = -1e-5f;  // by rounding
  LowestBounds lowest;
  lowest.begin(20, 1.0f);
  addInParts(bounds, lowest);
  EXPECT_THAT(lowest.slots, testing::Contains(1250u));
}

TEST(LowestBounds, ManyEqualOnesAreCountedRightly) {
  const std::vector<float> bounds(70000, 1.0f);
  LowestBounds lowest;
  lowest.begin(1, 1.0f);
  addInParts(bounds, lowest);
  EXPECT_EQ(lowest.bounds.size(), bounds.size());
}

TEST(LowestBounds, BeginsAnew) {
  LowestBounds lowest;
  lowest.begin(10, 1.0f);
  addInParts(randomBounds(300), lowest);
  EXPECT_LT(lowest.highest(), 1.0f);
  lowest.begin(10, 1.0f);
  EXPECT_TRUE(lowest.slots.empty());
  EXPECT_GT(lowest.highest(), 1e30f);
}

}  // namespace
}  // namespace sks::test
