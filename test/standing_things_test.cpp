// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/standing_things.hpp"

#include <random>

#include <gtest/gtest.h>

#include "prepared.hpp"
#include "synthetic.hpp"

namespace sks {
namespace {

using test::Solid;

constexpr float largest_thing = 0.15f;  // [m]

Solid boxOn(float x, float y, float bottom, float length, float width, float height) {
  return {Solid::Shape::box, {x, y, bottom + 0.5f * height}, {0.5f * length, 0.5f * width, 0.5f * height}};
}

/// A table of half a metre under a camera 0.8 m away, 50 degrees above it, and things on it (z up, table at 0).
Cloud onTable(const test::Shape& things) {
  test::Shape shape = things;
  shape.push_back(boxOn(0, 0, -0.02f, 0.5f, 0.5f, 0.02f));
  Cloud cloud = test::view({{shape, test::poseOf(140, {1, 0, 0}, {0, 0, 0.8f})}});
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.0012f);  // [m] of a Kinect at this range
  for (Eigen::Vector3f& p : cloud.points) p += noise(random) * p.normalized();
  return cloud;
}

StandingThings thingsOf(const Cloud& cloud) {
  const Surface surface = test::prepared(cloud);
  return findStandingThings(surface, findLargePlanes(surface), largest_thing);
}

TEST(StandingThings, MeasuresWhatStandsOnATable) {
  const StandingThings standing = thingsOf(onTable({boxOn(-0.06f, 0, 0, 0.1f, 0.05f, 0.03f)}));
  ASSERT_EQ(standing.things.size(), 1u);
  const StandingThing& thing = standing.things[0];
  EXPECT_NEAR(thing.height, 0.03, 0.004);  // the highest of points with noise
  EXPECT_NEAR(thing.base.length, 0.1, 0.012);
  EXPECT_LE(thing.base.width, 0.062f);
  const Eigen::Vector3f up = test::poseOf(140, {1, 0, 0}, Eigen::Vector3f::Zero()) * Eigen::Vector3f::UnitZ();
  EXPECT_GT(thing.up.dot(up), 0.9998f);                                            // 1 degree
  EXPECT_GT(std::abs(thing.base.long_axis.dot(Eigen::Vector3f::UnitX())), 0.97f);  // 14 degrees
}

TEST(StandingThings, ThingsOfSixMillimetresRise) {
  const Cloud table = onTable({}), card = onTable({boxOn(0.03f, 0.02f, 0, 0.085f, 0.054f, 0.006f)});
  EXPECT_TRUE(thingsOf(table).things.empty());
  const Surface surface = test::prepared(card);
  const StandingThings standing = findStandingThings(surface, findLargePlanes(surface), largest_thing);
  ASSERT_EQ(standing.things.size(), 1u);
  EXPECT_NEAR(standing.things[0].height, 0.006, 0.004);
  int of_card = 0, rising = 0, wrong = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f p = test::poseOf(140, {1, 0, 0}, {0, 0, 0.8f}).inverse() * surface.point(i);
    const bool on_card = std::abs(p.x() - 0.03f) < 0.035f && std::abs(p.y() - 0.02f) < 0.02f;
    const bool near_card = std::abs(p.x() - 0.03f) < 0.06f && std::abs(p.y() - 0.02f) < 0.045f;
    of_card += on_card;
    rising += on_card && standing.rises[i] != 0;
    wrong += !near_card && standing.rises[i] != 0;
  }
  EXPECT_GT(rising, 0.9 * of_card);
  EXPECT_LT(wrong, 0.005 * double(surface.size()));
}

TEST(StandingThings, WhatTouchesIsOneThingAndWhatHangsIsNone) {
  const Solid left = boxOn(-0.04f, 0, 0, 0.05f, 0.05f, 0.04f), right = boxOn(0.01f, 0, 0, 0.05f, 0.05f, 0.04f);
  EXPECT_EQ(thingsOf(onTable({left, right})).things.size(), 1u);
  const Solid apart = boxOn(0.07f, 0, 0, 0.05f, 0.05f, 0.04f);
  EXPECT_EQ(thingsOf(onTable({left, apart})).things.size(), 2u);
  const Solid hangs = boxOn(0, 0, 0.08f, 0.05f, 0.05f, 0.02f);
  EXPECT_TRUE(thingsOf(onTable({hangs})).things.empty());
}

TEST(StandingThings, FurnitureIsNone) {
  EXPECT_TRUE(thingsOf(onTable({boxOn(0, 0, 0, 0.25f, 0.06f, 0.03f)})).things.empty());
}

TEST(StandingThings, NothingStandsWhereNoPlaneIs) {
  const StandingThings standing = thingsOf(test::randomCloud(500, 0.5f, 3));
  EXPECT_TRUE(standing.things.empty());
  EXPECT_EQ(standing.rises.size(), 500u);
}

}  // namespace
}  // namespace sks
