// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/tabletop.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "synthetic.hpp"

namespace sks {
namespace {

using test::Placed;
using test::Shape;
using test::Solid;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr float table_height = 0.3f;  // of its top below the camera's axis, +y is down [m]

/// A box of these full extents whose underside lies `lift` above the table.
Placed standing(const Eigen::Vector3f& size, float x, float z, float lift = 0) {
  const Eigen::Vector3f center(x, table_height - lift - 0.5f * size.y(), z);
  return {{{Solid::Shape::box, center, 0.5f * size}}, Eigen::Isometry3f::Identity()};
}

Placed slab(const Eigen::Vector3f& center, const Eigen::Vector3f& half) {
  return {{{Solid::Shape::box, center, half}}, Eigen::Isometry3f::Identity()};
}

Placed table() {
  return slab({0, table_height + 0.02f, 0.9f}, {0.4f, 0.02f, 0.35f});
}

/// As seen by a camera that looks down by 25 degrees; the table is level in the frame of `things`.
Cloud seen(std::vector<Placed> things, bool color = true) {
  const Eigen::Isometry3f tilt = test::poseOf(25, Eigen::Vector3f::UnitX(), Eigen::Vector3f::Zero());
  for (Placed& thing : things) thing.T_camera_shape = tilt * thing.T_camera_shape;
  return test::view(things, 0.005f, 160, 120, color);
}

Eigen::Vector3f centerOf(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  Eigen::AlignedBox3f box;
  const Eigen::Isometry3f back = test::poseOf(-25, Eigen::Vector3f::UnitX(), Eigen::Vector3f::Zero());
  for (const std::uint32_t i : points) box.extend(back * cloud.points[i]);
  return box.center();
}

TEST(Tabletop, FindsTheOneObject) {
  const Cloud cloud = seen({table(), standing({0.08f, 0.15f, 0.06f}, 0.1f, 0.8f)});
  const Tabletop tabletop = findTabletop(cloud);
  ASSERT_THAT(tabletop.objects, SizeIs(1));
  EXPECT_NEAR(centerOf(cloud, tabletop.objects[0]).x(), 0.1f, 0.01f);
  EXPECT_NEAR(tabletop.area, 0.8 * 0.7, 0.1) << "the image's border cuts the near corners off";
  EXPECT_GT(tabletop.plane.signedDistance(Eigen::Vector3f::Zero()), 0.2f) << "the normal points to the camera";
  EXPECT_TRUE(std::is_sorted(tabletop.objects[0].begin(), tabletop.objects[0].end()));
}

TEST(Tabletop, FindsNothingOnAnEmptyTable) {
  EXPECT_THAT(findTabletop(seen({table()})).objects, IsEmpty());
}

TEST(Tabletop, CountsSeveralLargestFirst) {
  const Cloud cloud = seen({table(), standing({0.05f, 0.08f, 0.05f}, -0.2f, 0.8f),
                            standing({0.1f, 0.2f, 0.08f}, 0.15f, 0.9f), standing({0.07f, 0.1f, 0.06f}, 0, 0.7f)});
  const Tabletop tabletop = findTabletop(cloud);
  ASSERT_THAT(tabletop.objects, SizeIs(3));
  EXPECT_NEAR(centerOf(cloud, tabletop.objects[0]).x(), 0.15f, 0.01f);
  EXPECT_NEAR(centerOf(cloud, tabletop.objects[2]).x(), -0.2f, 0.01f);
}

TEST(Tabletop, LeavesOutStrayPoints) {
  const Cloud cloud =
      seen({table(), standing({0.3f, 0.25f, 0.2f}, 0.15f, 0.9f), standing({0.02f, 0.03f, 0.02f}, -0.2f, 0.8f)});
  TabletopSettings settings;
  settings.min_points = 5;
  settings.min_share = 0.05;
  EXPECT_THAT(findTabletop(cloud, settings).objects, SizeIs(1));
  settings.min_share = 0;
  EXPECT_THAT(findTabletop(cloud, settings).objects, SizeIs(2));
}

TEST(Tabletop, LooksPastALargerWall) {
  const Placed wall = slab({0, -0.3f, 1.6f}, {2, 1.2f, 0.02f});
  const Cloud cloud = seen({wall, table(), standing({0.08f, 0.15f, 0.06f}, -0.1f, 0.8f)});
  const Tabletop tabletop = findTabletop(cloud);
  ASSERT_THAT(tabletop.objects, SizeIs(1));
  EXPECT_NEAR(centerOf(cloud, tabletop.objects[0]).x(), -0.1f, 0.01f);
}

TEST(Tabletop, TakesNoWallForAnObject) {
  const Placed wall = slab({0, table_height - 0.1f, 1.27f}, {0.25f, 0.1f, 0.02f});  // bounds the far end of the table
  const Tabletop tabletop = findTabletop(seen({table(), wall, standing({0.08f, 0.15f, 0.06f}, 0, 0.8f)}));
  EXPECT_THAT(tabletop.objects, SizeIs(1));
}

TEST(Tabletop, IgnoresWhatFloatsAndWhatIsBelow) {
  const Placed floor = slab({0, 1.0f, 1.2f}, {0.3f, 0.02f, 1.0f});
  const Tabletop tabletop = findTabletop(seen({table(), floor, standing({0.1f, 0.05f, 0.05f}, 0.1f, 0.8f, 0.12f)}));
  EXPECT_THAT(tabletop.objects, IsEmpty());
}

/// A large lid, and what rises from it at its front edge and goes on below it.
TEST(Tabletop, TakesNoPartOfAHeldThingForAnObject) {
  const float lid = table_height;
  const Placed box = slab({0, lid + 0.1f, 0.9f}, {0.3f, 0.1f, 0.25f});
  const Placed before = slab({0, lid - 0.03f, 0.64f}, {0.03f, 0.05f, 0.02f});
  EXPECT_THAT(findTabletop(seen({box, before})).objects, IsEmpty());
  const Placed on_the_lid = slab({0, lid - 0.05f, 0.8f}, {0.03f, 0.05f, 0.02f});
  EXPECT_THAT(findTabletop(seen({box, on_the_lid})).objects, SizeIs(1));
}

/// Lids of smaller boxes, and arms, are no tables.
TEST(Tabletop, NeedsAPlaneThatIsLargeEnough) {
  const Placed box = slab({0, table_height + 0.1f, 0.8f}, {0.07f, 0.1f, 0.07f});
  const Placed knob = slab({0, table_height - 0.05f, 0.8f}, {0.03f, 0.05f, 0.02f});
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data,
                            [&] {
                              findTabletop(seen({box, knob}));
                            }),
              testing::StartsWith("there is no plane in the cloud"));
}

TEST(Tabletop, ToleratesNoiseAndNaN) {
  Cloud cloud = seen({table(), standing({0.08f, 0.15f, 0.06f}, 0.1f, 0.8f)});
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.002f);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % 7 == 0) cloud.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
    if (i % 11 == 0) cloud.points[i].setZero();  // what some drivers give where nothing was measured
    cloud.points[i] *= 1 + noise(random);
  }
  EXPECT_THAT(findTabletop(cloud).objects, SizeIs(1));
}

TEST(Tabletop, DoesNotDependOnTheOrderOfPoints) {
  const Cloud cloud = seen({table(), standing({0.08f, 0.15f, 0.06f}, 0.1f, 0.8f)});
  const auto first = findTabletop(cloud).objects;
  EXPECT_THAT(findTabletop(cloud).objects, ElementsAreArray(first));
  const auto other = findTabletop(test::shuffled(cloud, 3)).objects;
  ASSERT_THAT(other, SizeIs(1));
  EXPECT_EQ(other[0].size(), first[0].size());
}

TEST(Tabletop, NeedsAPlane) {
  const auto refusal = [](const Cloud& cloud) {
    return test::errorOf(ErrorCode::bad_data, [&] { findTabletop(cloud); });
  };
  EXPECT_THAT(refusal(Cloud()), HasSubstr("no plane in the cloud (0 measured points)"));
  Cloud invalid = seen({table()});
  for (auto& p : invalid.points) p.setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(refusal(invalid), HasSubstr("0 measured"));
  EXPECT_THAT(refusal(seen({standing({0.08f, 0.15f, 0.06f}, 0, 0.6f)})), HasSubstr("no plane"));
}

TEST(CutOut, KeepsTheWindowOfAnOrganisedCloud) {
  Cloud cloud;
  cloud.width = 4;
  cloud.height = 3;
  for (int i = 0; i < 12; ++i) {
    cloud.points.emplace_back(float(i), 0.0f, 1.0f);
    cloud.colors.push_back({std::uint8_t(i), 0, 0});
  }
  const Cloud cut = cutOut(cloud, {5, 6, 10});
  EXPECT_EQ(cut.width, 2u);
  EXPECT_EQ(cut.height, 2u);
  EXPECT_EQ(cut.points[0], cloud.points[5]);
  EXPECT_EQ(cut.points[1], cloud.points[6]);
  EXPECT_TRUE(std::isnan(cut.points[2].x()));
  EXPECT_EQ(cut.points[3], cloud.points[10]);
  EXPECT_EQ(cut.colors[3].r, 10);
}

TEST(CutOut, ListsThePointsOfAnUnorganisedCloud) {
  const Cloud cut = cutOut(test::makeCloud({{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}), {0, 2});
  EXPECT_EQ(cut.width, 2u);
  EXPECT_EQ(cut.height, 1u);
  EXPECT_EQ(cut.points[1], Eigen::Vector3f(2, 0, 1));
  EXPECT_FALSE(cut.hasColor());
}

}  // namespace
}  // namespace sks
