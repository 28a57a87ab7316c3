// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pile_parts.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace sks {
namespace {

constexpr float spacing = 0.0075f;  // [m]
const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();

/// Points of rectangles that lie level, with the noise that is left of a Kinect's in 1 m.
class Pile {
public:
  /// @param angle of the length with the x axis [rad]
  Pile& add(const Eigen::Vector3f& center, float length, float width, float angle = 0) {
    const Eigen::Vector3f along(std::cos(angle), std::sin(angle), 0), across = up.cross(along);
    std::normal_distribution<float> noise(0, 0.001f);
    for (float a = -0.5f * length; a <= 0.5f * length; a += spacing) {
      for (float b = -0.5f * width; b <= 0.5f * width; b += spacing) {
        points_.add(center + a * along + b * across + noise(random_) * up, up);
      }
    }
    return *this;
  }

  std::vector<PilePart> parts(float stick_width = 0) const { return pileParts(points_, spacing, up, stick_width); }

private:
  OrientedPoints points_;
  std::mt19937 random_{1};
};

/// The part whose centroid is nearest to a place, and whose length is right.
const PilePart* partAt(const std::vector<PilePart>& parts, const Eigen::Vector3f& center, float length) {
  const PilePart* nearest = nullptr;
  for (const PilePart& part : parts) {
    if (std::abs(part.base.length - length) > 0.02f) continue;
    if (nearest == nullptr || (part.centroid - center).norm() < (nearest->centroid - center).norm()) nearest = &part;
  }
  return nearest;
}

TEST(PileParts, CardsOnEachOtherAreTwoFaces) {
  const Eigen::Vector3f below(0, 0, 0.006f), above(0.08f, 0.05f, 0.012f);
  const auto parts = Pile().add(below, 0.16f, 0.08f).add(above, 0.1f, 0.06f).parts();
  for (const auto& [center, length] : {std::make_pair(below, 0.16f), {above, 0.1f}}) {
    const PilePart* part = partAt(parts, center, length);
    ASSERT_NE(part, nullptr);
    EXPECT_LT((part->centroid - center).norm(), 0.01f);
    EXPECT_GT(part->up.dot(up), 0.99f);
    EXPECT_FALSE(part->stick);
  }
}

TEST(PileParts, LevelFacesAreCutWhereTheyTouch) {
  const Eigen::Vector3f left(0, 0, 0.006f), right(0.11f, 0.095f, 0.006f);  // corner at corner
  const auto parts = Pile().add(left, 0.12f, 0.1f).add(right, 0.1f, 0.1f).parts();
  ASSERT_GE(parts.size(), 3u) << "the whole and two pieces";
  EXPECT_GT(parts[0].base.length, 0.2f);
  for (const Eigen::Vector3f& center : {left, right}) {
    const bool found = std::any_of(parts.begin() + 1, parts.end(),
                                   [&](const PilePart& p) { return (p.centroid - center).norm() < 0.015f; });
    EXPECT_TRUE(found) << center.transpose();
  }
}

TEST(PileParts, CrossingSticksAreTwo) {
  const float width = 0.013f;
  const Eigen::Vector3f below(0, 0, 0.013f), above(0.03f, 0, 0.026f);
  const auto parts = Pile().add(below, 0.3f, width).add(above, 0.2f, width, 1.2f).parts(width);
  ASSERT_EQ(std::count_if(parts.begin(), parts.end(), [](const PilePart& p) { return p.stick; }), 2);
  const PilePart *longer = partAt(parts, below, 0.3f), *shorter = partAt(parts, above, 0.2f);
  ASSERT_TRUE(longer != nullptr && shorter != nullptr);
  EXPECT_GT(std::abs(longer->base.long_axis.x()), 0.99f);
  EXPECT_GT(std::abs(shorter->base.long_axis.dot(Eigen::Vector3f(std::cos(1.2f), std::sin(1.2f), 0))), 0.99f);
  EXPECT_LT((longer->centroid - below).norm(), 0.01f);
  EXPECT_LT((shorter->centroid - above).norm(), 0.01f);
}

TEST(PileParts, AnEdgeIsNoStickAndAFewPointsAreNothing) {
  for (const PilePart& part : Pile().add({0, 0, 0.006f}, 0.2f, 0.1f).parts(0.013f)) EXPECT_FALSE(part.stick);
  EXPECT_TRUE(Pile().add({0, 0, 0.006f}, 0.02f, 0.02f).parts(0.013f).empty());
  EXPECT_TRUE(Pile().parts(0.013f).empty());
}

}  // namespace
}  // namespace sks
