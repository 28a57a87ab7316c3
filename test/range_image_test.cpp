// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/range_image.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "prepared.hpp"
#include "synthetic.hpp"

namespace sks::test {
namespace {

/// A wall of 1 m at z = 1 and, before its right half, one at z = 0.7.
Cloud twoWalls() {
  const Shape back{{Solid::Shape::box, {0, 0, 0}, {0.5f, 0.5f, 0.005f}}};
  const Shape front{{Solid::Shape::box, {0, 0, 0}, {0.15f, 0.3f, 0.005f}}};
  return view({{back, poseOf(0, {0, 0, 1}, {0, 0, 1.005f})}, {front, poseOf(0, {0, 0, 1}, {0.15f, 0, 0.705f})}},
              0.0025f, 400, 400);
}

TEST(RangeImage, KnowsWhatIsHiddenSeenAndSeenThrough) {
  const RangeImage image(prepared(twoWalls()), 0.01f);
  EXPECT_EQ(image.look({-0.2f, 0, 1.0f}, 0.015f).sight, Sight::at);
  EXPECT_EQ(image.look({-0.2f, 0, 1.01f}, 0.015f).sight, Sight::at);
  EXPECT_EQ(image.look({-0.2f, 0, 1.1f}, 0.015f).sight, Sight::occluded);
  EXPECT_EQ(image.look({-0.2f, 0, 0.9f}, 0.015f).sight, Sight::in_front);
  EXPECT_EQ(image.look({0.1f, 0, 0.7f}, 0.015f).sight, Sight::at);
  EXPECT_EQ(image.look({0.1f, 0, 1.0f}, 0.015f).sight, Sight::occluded);
}

TEST(RangeImage, KnowsNothingOfWhatWasNotMeasured) {
  const RangeImage image(prepared(twoWalls()), 0.01f);
  EXPECT_EQ(image.look({0.8f, 0, 1}, 0.015f).sight, Sight::unknown);    // beside the wall
  EXPECT_EQ(image.look({-0.2f, 0, -1}, 0.015f).sight, Sight::unknown);  // behind the camera
  EXPECT_EQ(image.look({0, 0, 0}, 0.015f).sight, Sight::unknown);       // the camera itself
}

TEST(RangeImage, GivesThePointThatWasSeen) {
  const Surface scene = prepared(twoWalls());
  const RangeImage image(scene, 0.01f);
  for (const Eigen::Vector3f& place : {Eigen::Vector3f(-0.2f, 0.1f, 1.3f), Eigen::Vector3f(0.1f, 0, 0.5f)}) {
    const Sighting seen = image.look(place, 0.015f);
    ASSERT_TRUE(seen.hasPoint());
    const Eigen::Vector3f position = seen.cell->position();
    EXPECT_LT((position - place * (position.z() / place.z())).norm(), 0.01f);
    EXPECT_EQ(scene.point(image.pointOf(seen)), position);
    EXPECT_EQ(scene.normal(image.pointOf(seen)), seen.cell->normal());
  }
  EXPECT_NEAR(image.look({0.1f, 0, 1}, 0.015f).cell->z, 0.7f, 0.002f);
  EXPECT_EQ(image.pointOf(image.look({0.8f, 0, 1}, 0.015f)), no_point);
}

TEST(RangeImage, DoesNotDependOnThreads) {
  const Surface scene = prepared(twoWalls());
  const RangeImage one(scene, 0.01f, 1), three(scene, 0.01f, 3);
  ASSERT_EQ(one.cells().size(), three.cells().size());
  for (std::size_t i = 0; i < one.cells().size(); ++i) {
    EXPECT_EQ(one.cells()[i].nearest, three.cells()[i].nearest);
    EXPECT_EQ(one.cells()[i].farthest, three.cells()[i].farthest);
    EXPECT_EQ(std::isnan(one.cells()[i].x), std::isnan(three.cells()[i].x));
    if (std::isnan(one.cells()[i].x)) continue;
    EXPECT_EQ(one.cells()[i].position(), three.cells()[i].position());
  }
}

TEST(RangeImage, MovesWithTheSensor) {
  const Eigen::Isometry3f T = poseOf(130, {1, 2, 3}, {3, -1, 0.5f});
  const RangeImage image(prepared(transformed(twoWalls(), T)), 0.01f);
  EXPECT_EQ(image.look(T * Eigen::Vector3f(-0.2f, 0, 1.1f), 0.015f).sight, Sight::occluded);
  EXPECT_EQ(image.look(T * Eigen::Vector3f(-0.2f, 0, 0.9f), 0.015f).sight, Sight::in_front);
}

}  // namespace
}  // namespace sks::test
