// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/scene.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/convex_parts.hpp"
#include "simulation/mesh_symmetry.hpp"
#include "simulation/shapes.hpp"
#include "simulation/table_physics.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<SceneModel> builtinModels() {
  std::vector<SceneModel> models;
  for (const std::string& name : builtinNames()) {
    models.push_back({name, "builtin:" + name, std::make_shared<const Mesh>(builtinObject(name))});
  }
  return models;
}

TEST(BuiltinObjects, AreColouredAndOfHouseholdSize) {
  EXPECT_THAT(builtinNames(), ElementsAre("mug", "bottle", "bowl", "box", "drill", "duck"));
  for (const std::string& name : builtinNames()) {
    const Mesh mesh = builtinObject(name);
    EXPECT_EQ(mesh.colors.size(), mesh.vertices.size()) << name;
    EXPECT_GT(mesh.box().sizes().minCoeff(), 0.04f) << name;
    EXPECT_LT(mesh.box().sizes().maxCoeff(), 0.25f) << name;
    EXPECT_NEAR(mesh.box().min().z(), 0, 0.003f) << name;
  }
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [] { findMesh("builtin:mig"); }),
              HasSubstr("no built-in object 'mig': use one of mug, bottle"));
}

TEST(MeshSymmetry, IsThatOfShapeAndColour) {
  const auto bowl = estimateSymmetry(builtinObject("bowl"));
  ASSERT_TRUE(bowl);
  EXPECT_EQ(bowl->order, 0);
  EXPECT_NEAR(std::abs(bowl->axis.z()), 1, 1e-3);
  for (const char* name : {"mug", "bottle", "box", "drill", "duck"}) {
    EXPECT_FALSE(estimateSymmetry(builtinObject(name))) << name;
  }
  const auto pillar = estimateSymmetry(makeBox({0.1f, 0.1f, 0.3f}, plain({200, 30, 30}), 0.01f));
  ASSERT_TRUE(pillar);
  EXPECT_EQ(pillar->order, 4);
}

TEST(ConvexParts, KeepHollowsHollow) {
  EXPECT_EQ(convexParts(makeBox({0.1f, 0.1f, 0.1f}, plain({}), 0.01f)).size(), 1u);
  EXPECT_GT(convexParts(builtinObject("bowl")).size(), 8u);
}

TEST(TablePhysics, BoxLandsOnItsFace) {
  const RigidBody box(makeBox({0.1f, 0.06f, 0.2f}, plain({}), 0.02f));
  TablePhysics physics(0.5);
  ASSERT_TRUE(physics.drop(box, 0.05, -0.02, Eigen::Quaterniond(1, 0, 0, 0), 0.3));
  const auto poses = physics.settle();
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_NEAR(poses[0].translation().z(), 0.1, 0.003);
  EXPECT_NEAR(poses[0].translation().x(), 0.05, 0.02);
}

TEST(TablePhysics, BallFallsIntoTheBowl) {
  const RigidBody bowl(builtinObject("bowl")), ball(makeSphere(0.02f, 3, plain({})));
  TablePhysics physics(0.5);
  ASSERT_TRUE(physics.drop(bowl, 0, 0, Eigen::Quaterniond(1, 0, 0, 0), 0.3));
  ASSERT_TRUE(physics.drop(ball, 0.005, 0, Eigen::Quaterniond(1, 0, 0, 0), 0.3));
  const auto poses = physics.settle();
  EXPECT_LT(poses[1].translation().z(), 0.045);  // 6 mm of bottom and its radius, not on a lid at 65 mm
  EXPECT_GT(poses[1].translation().z(), 0.02);
}

TEST(TablePhysics, WhatFallsBesideTheRegionIsGone) {
  const RigidBody ball(makeSphere(0.02f, 3, plain({})));
  TablePhysics physics(0.5);
  EXPECT_FALSE(physics.drop(ball, 0.6, 0, Eigen::Quaterniond(1, 0, 0, 0), 0.3));
  EXPECT_TRUE(physics.settle().empty());
}

TEST(Scene, TruthIsWhereTheObjectIsSeen) {
  SceneOptions options;
  options.camera.noise = CameraNoise::none();
  const std::vector<SceneModel> models = builtinModels();
  const SimulatedScene scene = simulateScene(models, options, 3);
  ASSERT_EQ(scene.objects.size(), 5u);
  std::size_t on_objects = 0;
  for (const ScenePlacement& placed : scene.objects) {
    EXPECT_GE(placed.visibility, 0);
    EXPECT_LE(placed.visibility, 1);
    const Eigen::AlignedBox3f box = models[placed.model].mesh->box();
    EXPECT_GT((scene.T_table_camera * placed.T_camera_model * box.center().cast<double>()).z(), 0.01);
    const Eigen::Isometry3d T_model_camera = placed.T_camera_model.inverse();
    for (std::size_t i = 0; i < scene.view.cloud.size(); i += 7) {
      if (!scene.view.cloud.points[i].allFinite()) continue;
      on_objects += box.contains((T_model_camera * scene.view.cloud.points[i].cast<double>()).cast<float>().eval());
    }
  }
  EXPECT_GT(on_objects, 1000u);
}

TEST(Scene, SameSeedSameSceneForAnyNumberOfThreads) {
  SceneOptions options;
  options.objects = 3;
  options.threads = 1;
  const std::vector<SceneModel> models = builtinModels();
  const SimulatedScene first = simulateScene(models, options, 0);
  options.threads = 2;
  const SimulatedScene second = simulateScene(models, options, 0);
  ASSERT_EQ(first.objects.size(), second.objects.size());
  for (std::size_t i = 0; i < first.objects.size(); ++i) {
    EXPECT_EQ(first.objects[i].T_camera_model.matrix(), second.objects[i].T_camera_model.matrix());
    EXPECT_EQ(first.objects[i].visibility, second.objects[i].visibility);
  }
  EXPECT_EQ(first.view.instance, second.view.instance);
  const auto same = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return a == b || (a.hasNaN() && b.hasNaN());
  };
  EXPECT_TRUE(std::equal(first.view.cloud.points.begin(), first.view.cloud.points.end(),
                         second.view.cloud.points.begin(), same));
  options.seed = 2;
  EXPECT_NE(simulateScene(models, options, 0).view.instance, first.view.instance);
}

TEST(Scene, OneObjectCanStandThereThreeTimes) {
  SceneOptions options;
  options.objects = 3;
  options.distractors = 0;
  const SimulatedScene scene = simulateScene({builtinModels().front()}, options, 0);
  EXPECT_EQ(scene.objects.size(), 3u);
}

TEST(Scene, RefusesImpossibleOptions) {
  const auto refusal = [](auto change) {
    SceneOptions options;
    change(options);
    return test::errorOf(ErrorCode::bad_usage, [&] { validate(options); });
  };
  EXPECT_THAT(refusal([](SceneOptions& o) { o.objects = -1; }), HasSubstr("scene: objects = -1"));
  EXPECT_THAT(refusal([](SceneOptions& o) { o.region = 1; }), HasSubstr("region"));
  EXPECT_THAT(refusal([](SceneOptions& o) { o.max_elevation = 100; }), HasSubstr("max_elevation"));
}

}  // namespace
}  // namespace sks
