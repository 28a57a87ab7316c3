// SPDX-License-Identifier: BSD-3-Clause
// What comes into a planning scene, moves and goes.
#include "planning_scene/scene_objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sks_detector {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double frame_time = 0.1;  // [s]

SceneBox boxAt(double x, double turn = 0) {
  SceneBox box;
  box.T_scene_box = Eigen::Translation3d(x, 0, 1) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  box.size = {0.1, 0.06, 0.2};
  return box;
}

SeenObject mug(double x, std::uint32_t track = 0, double turn = 0) {
  return {track, "mug", boxAt(x, turn)};
}

/// One frame after another.
class SceneObjectsTest : public testing::Test {
protected:
  SceneChange see(const std::vector<SeenObject>& seen) { return objects.takeObjects(now += frame_time, seen); }
  SceneChange seeSupport(const std::optional<SceneBox>& box) { return objects.takeSupport(now += frame_time, box); }
  /// What has to be seen until it is in the scene.
  SceneChange settle(const std::vector<SeenObject>& seen) {
    for (int i = 1; i < settings.add_after; ++i) see(seen);
    return see(seen);
  }

  static std::vector<std::string> ids(const std::vector<SceneObject>& objects) {
    std::vector<std::string> names;
    for (const SceneObject& object : objects) names.push_back(object.id);
    return names;
  }

  PlanningSceneSettings settings;
  SceneObjects objects{settings};
  double now = 1000;
};

TEST_F(SceneObjectsTest, ComeAfterAFewFramesInARow) {
  EXPECT_TRUE(see({mug(0)}).empty());
  EXPECT_TRUE(see({mug(0)}).empty());
  EXPECT_TRUE(see({}).empty());  // begins anew
  EXPECT_TRUE(see({mug(0)}).empty());
  EXPECT_TRUE(see({mug(0)}).empty());
  const SceneChange change = see({mug(0.001)});
  ASSERT_THAT(ids(change.put), ElementsAre("object_1"));
  EXPECT_EQ(change.put[0].name, "mug");
  EXPECT_EQ(change.put[0].box.T_scene_box.translation().x(), 0.001);
  EXPECT_EQ(change.put[0].box.size.z(), 0.2);
  EXPECT_THAT(change.removed, IsEmpty());
}

TEST_F(SceneObjectsTest, StayAsTheyAreWhileTheyHardlyMove) {
  settle({mug(0)});
  EXPECT_TRUE(see({mug(0.004)}).empty());
  EXPECT_TRUE(see({mug(0.001, 0, 0.04)}).empty());
  EXPECT_TRUE(see({mug(0, 0, EIGEN_PI)}).empty()) << "a box looks the same after half a turn";
  const SceneChange moved = see({mug(0.006)});
  ASSERT_THAT(ids(moved.put), ElementsAre("object_1"));
  EXPECT_EQ(moved.put[0].box.T_scene_box.translation().x(), 0.006);
  EXPECT_TRUE(see({mug(0.008)}).empty()) << "it is compared with what the scene holds";
  EXPECT_THAT(ids(see({mug(0.006, 0, 0.06)}).put), ElementsAre("object_1"));
}

TEST_F(SceneObjectsTest, GoOnceFramesNoLongerShowThem) {
  settle({mug(0), mug(0.5)});
  EXPECT_TRUE(objects.takeObjects(now + settings.remove_after - frame_time, {mug(0.5)}).empty());
  now += settings.remove_after;
  EXPECT_THAT(see({mug(0.5)}).removed, ElementsAre("object_1"));
  EXPECT_THAT(ids(objects.all()), ElementsAre("object_2"));
  EXPECT_THAT(ids(settle({mug(0), mug(0.5)}).put), ElementsAre("object_3")) << "no id is used again";
}

TEST_F(SceneObjectsTest, KeepTheirIdWhileTheyAreFollowedFarOrFoundNear) {
  settle({mug(0, 7), mug(0.5, 8)});
  EXPECT_THAT(ids(see({mug(0.5, 7), mug(0, 8)}).put), ElementsAre("object_1", "object_2")) << "they changed places";
  see({mug(0, 8)});
  const SceneChange again = see({mug(0.51, 9), mug(0, 8)});  // lost, and found anew where it was
  EXPECT_THAT(ids(again.put), ElementsAre("object_1"));
  EXPECT_TRUE(see({mug(0.51, 9), {0, "jug", boxAt(0)}}).empty()) << "another object is in its place";
}

TEST_F(SceneObjectsTest, OfOneKindAreToldApartByTheirPlaces) {
  settle({mug(0), mug(0.04)});
  const SceneChange moved = see({mug(0.05), mug(0.01)});
  ASSERT_THAT(ids(moved.put), ElementsAre("object_1", "object_2"));
  EXPECT_EQ(moved.put[0].box.T_scene_box.translation().x(), 0.01);
}

TEST_F(SceneObjectsTest, ASupportIsOneThingMoreAndMayGrowALittle) {
  SceneBox table = boxAt(0);
  table.size = {0.8, 0.6, 0.02};
  for (int i = 1; i < settings.add_after; ++i) EXPECT_TRUE(seeSupport(table).empty());
  EXPECT_THAT(ids(seeSupport(table).put), ElementsAre("support"));
  SceneBox more = table;
  more.size.x() += 0.015;
  more.T_scene_box.translation().x() += 0.0075;
  EXPECT_TRUE(seeSupport(more).empty());
  more.T_scene_box.translation().z() += 0.006;
  EXPECT_THAT(ids(seeSupport(more).put), ElementsAre("support"));
  more.size.x() += 0.03;
  EXPECT_THAT(ids(seeSupport(more).put), ElementsAre("support"));
  now += settings.remove_after;
  EXPECT_THAT(seeSupport(std::nullopt).removed, ElementsAre("support"));
  EXPECT_TRUE(seeSupport(std::nullopt).empty());
}

TEST_F(SceneObjectsTest, ClearTakesAllAway) {
  settle({mug(0), mug(0.5)});
  for (int i = 0; i < settings.add_after; ++i) seeSupport(boxAt(2));
  see({mug(0), mug(0.5), mug(1)});
  EXPECT_THAT(objects.clear().removed, ElementsAre("object_1", "object_2", "support"));
  EXPECT_THAT(objects.all(), IsEmpty());
  EXPECT_TRUE(objects.clear().empty());
  EXPECT_THAT(ids(settle({mug(0)}).put), ElementsAre("object_3"));
}

TEST_F(SceneObjectsTest, AFrameThatComesLateLetsNoTimePass) {
  settle({mug(0)});
  EXPECT_TRUE(objects.takeObjects(now - 0.5, {}).empty());
  EXPECT_TRUE(see({mug(0)}).empty());
}

TEST(TurnBetween, BoxesIsTheLeastOfTheirHalfTurns) {
  EXPECT_NEAR(turnBetween(boxAt(0, 0.3), boxAt(5, 0.1)), 0.2, 1e-9);
  EXPECT_NEAR(turnBetween(boxAt(0), boxAt(0, EIGEN_PI - 0.1)), 0.1, 1e-9);
  SceneBox upside_down = boxAt(0);
  upside_down.T_scene_box.rotate(Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(turnBetween(boxAt(0), upside_down), 0, 1e-6);
}

}  // namespace
}  // namespace sks_detector
