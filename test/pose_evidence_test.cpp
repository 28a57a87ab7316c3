// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_evidence.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/verification/rough_support.hpp"
#include "prepared.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::test {
namespace {

const Eigen::Isometry3f T_scene_shape = poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f});

/// The object as a camera sees it; `before` stands nearer to the camera, if given.
Surface sceneWith(const Shape& before = {}) {
  std::vector<Placed> placed{{asymmetricShape(), T_scene_shape}};
  const Shape wall{{Solid::Shape::box, {0, 0, 0}, {0.8f, 0.8f, 0.01f}}};
  placed.push_back({wall, poseOf(0, {0, 0, 1}, {0, 0, 1.2f})});
  if (!before.empty()) placed.push_back({before, poseOf(0, {0, 0, 1}, {0, 0, 0.5f})});
  return prepared(view(placed, 0.0025f, 240, 200));
}

/// A training view whose frame is the camera's: its true pose in sceneWith() is the identity.
const TrainingView& trained() {
  static const Codebook codebook =
      train({sampleOf("thing", view({{asymmetricShape(), T_scene_shape}}))}, Settings(), "synthetic");
  return codebook.views.at(0);
}

PoseEvidence evidenceAt(const Surface& surface, const Eigen::Isometry3d& T_scene_model) {
  const Settings settings;
  return examinePose(trained(), SurfaceWeights(trained()), SceneView(surface, settings), settings, T_scene_model);
}

Eigen::Isometry3d moved(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(PoseEvidence, ConfirmsTheTruePose) {
  const PoseEvidence evidence = evidenceAt(sceneWith(), moved(0, 0, 0));
  EXPECT_GT(evidence.supported, 0.9 * evidence.facing);
  EXPECT_GT(evidence.weighted_supported, 0.9 * evidence.weighted_visible);
  const double area = 25e-6 * double(trained().surface_points.size());  // [m^2] one point each 5 mm
  EXPECT_LE(evidence.facing, area);
  EXPECT_GT(evidence.facing, 0.8 * area);
  EXPECT_GT(evidence.confirming.size(), 500u);
}

TEST(PoseEvidence, WhatTheCameraSeesThroughSpeaksAgainstAPose) {
  const PoseEvidence evidence = evidenceAt(sceneWith(), moved(0, 0, -0.1));
  EXPECT_LT(evidence.weighted_supported, 0.1 * evidence.weighted_visible);
  EXPECT_GT(evidence.weighted_visible, 0);
}

TEST(PoseEvidence, WhatIsHiddenSpeaksNeitherWay) {
  const Shape board{{Solid::Shape::box, {0.1f, 0, 0}, {0.1f, 0.3f, 0.005f}}};  // before the right half
  const PoseEvidence free = evidenceAt(sceneWith(), moved(0, 0, 0));
  const PoseEvidence half = evidenceAt(sceneWith(board), moved(0, 0, 0));
  EXPECT_LT(half.supported, 0.75 * free.supported);
  EXPECT_LT(half.weighted_visible, 0.8 * free.weighted_visible);
  EXPECT_GT(half.weighted_supported, 0.8 * half.weighted_visible);
  EXPECT_DOUBLE_EQ(half.facing, free.facing);
  const PoseEvidence behind_the_wall = evidenceAt(sceneWith(), moved(0, 0, 1));
  EXPECT_EQ(behind_the_wall.supported, 0);
  EXPECT_LT(behind_the_wall.weighted_visible, 0.05 * free.weighted_visible);
}

TEST(PoseEvidence, LargePlanesSpeakNeitherWay) {
  TrainingView flat = trained();
  for (auto& point : flat.surface_points) point.z() = 0.8f;
  for (auto& normal : flat.surface_normals) normal = {0, 0, -1};
  const Settings settings;
  const Surface scene = sceneWith();
  SurfaceWeights surface_weights(flat);
  surface_weights.shape.assign(flat.surface_points.size(), 0.5f);
  const PoseEvidence on_the_wall =
      examinePose(flat, surface_weights, SceneView(scene, settings), settings, moved(0.25, 0, 0.39));
  EXPECT_GT(on_the_wall.facing, 0);
  EXPECT_LT(on_the_wall.supported, 0.1 * on_the_wall.facing);
}

TEST(PoseEvidence, FlatPartsAreLessTellingThanEdges) {
  const std::vector<float> weights = SurfaceWeights(trained()).shape;
  ASSERT_EQ(weights.size(), trained().surface_points.size());
  const auto [least, most] = std::minmax_element(weights.begin(), weights.end());
  EXPECT_GE(*least, 0);
  EXPECT_GT(*most, 0.1f);
  EXPECT_LE(*most, 1);
}

TEST(PoseEvidence, APointWeighsTheSameAloneAndAmongAll) {
  const TrainingView view = trained();
  const SurfaceWeights all(view);
  const RoughSurface some(view);
  ASSERT_GT(some.stride, 1u);
  ASSERT_EQ(some.sample.size, (view.surface_points.size() + some.stride - 1) / some.stride);
  for (std::size_t i = 0; i < some.sample.size; ++i) {
    const auto point = std::find(view.surface_points.begin(), view.surface_points.end(), some.sample.point(i));
    ASSERT_NE(point, view.surface_points.end());
    const auto number = std::size_t(point - view.surface_points.begin());
    EXPECT_EQ(number % some.stride, 0u);
    EXPECT_EQ(some.shape[i], all.shape[number]);
    EXPECT_EQ(some.shape_and_color[i], all.shape_and_color[number]);
  }
}

TEST(PoseEvidence, WeightsAreKnownOfAsManyPointsAsAreAskedFor) {
  const TrainingView view = trained();
  const SurfaceWeights all(view);
  const std::vector<TrainingView> views(3, view);
  const std::size_t few = 50, stride = strideFor(view, few);
  ASSERT_GT(stride, 2u);
  const WeightsOfViews lazy(views, few);
  const SurfaceWeights& some = lazy.at(2, stride);
  for (std::size_t i = 0; i < view.surface_points.size(); i += stride) {
    EXPECT_EQ(some.shape[i], all.shape[i]);
    EXPECT_EQ(some.shape_and_color[i], all.shape_and_color[i]);
  }
  EXPECT_EQ(&lazy.at(2, 3 * stride), &some);
  EXPECT_NE(some.shape, all.shape);  // not all of them
  EXPECT_EQ(lazy.at(2, 1).shape, all.shape);
  EXPECT_EQ(lazy.at(2, stride).shape_and_color, all.shape_and_color);
  EXPECT_EQ(lazy.at(0, 1).shape, all.shape);
}

TEST(PoseEvidence, RoughSupportTellsAGoodPoseFromABadOne) {
  const Settings settings;
  const Surface scene = sceneWith();
  const SceneView scene_view(scene, settings);
  const RoughSurface surface(trained());
  const RoughSupport good = roughSupport(surface, scene_view, moved(0.004, 0, 0));
  const RoughSupport bad = roughSupport(surface, scene_view, moved(0, 0, -0.2));
  EXPECT_GT(good.points, 50);
  EXPECT_GT(good.supported, 0.7 * good.visible);
  EXPECT_EQ(bad.points, 0);
  EXPECT_EQ(bad.supported, 0);
  EXPECT_GT(bad.visible, 0);
}

TEST(PoseEvidence, AGlanceAtFewPointsSpeaksForAll) {
  const Settings settings;
  const Surface scene = sceneWith();
  const SceneView scene_view(scene, settings);
  const RoughSurface surface(trained());
  RoughLimits glance;
  glance.glance = true;
  for (const double shift : {0.0, 0.02, 0.04}) {
    const RoughSupport all = roughSupport(surface, scene_view, moved(shift, 0, 0)),
                       few = roughSupport(surface, scene_view, moved(shift, 0, 0), glance);
    EXPECT_NEAR(few.supported, all.supported, 0.2 * all.visible);
    EXPECT_NEAR(few.visible, all.visible, 0.2 * all.visible);
    EXPECT_NEAR(few.points, all.points, 0.2 * all.facing);
    EXPECT_NEAR(few.facing, all.facing, 0.2 * all.facing);
  }
  EXPECT_EQ(roughSupport(surface, scene_view, moved(0, 0, -0.2), glance).supported, 0);
}

}  // namespace
}  // namespace sks::test
