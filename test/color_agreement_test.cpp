// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/color_agreement.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/verification/pose_evidence.hpp"
#include "prepared.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::test {
namespace {

const Eigen::Vector3f red(0.5f, 0.5f, 0.4f), dark_red(0.3f, 0.5f, 0.4f), blue(0.4f, 0.3f, -0.6f);  // scaled CIELab

/// A square of 0.1 m, one point each 5 mm, whose half with x > 0 may have another colour.
TrainingView square(const Eigen::Vector3f& left, const Eigen::Vector3f& right) {
  TrainingView view;
  for (int x = -10; x <= 10; ++x) {
    for (int y = -10; y <= 10; ++y) {
      view.surface_points.emplace_back(0.005f * float(x), 0.005f * float(y), 0);
      view.surface_normals.emplace_back(0, 0, 1);
      view.surface_colors.push_back(x > 0 ? right : left);
    }
  }
  return view;
}

TEST(ColorAgreement, LightnessCountsHalf) {
  EXPECT_EQ(squaredColorDifference(red, red), 0);
  EXPECT_NEAR(squaredColorDifference(red, dark_red), 10 * 10, 1e-3);  // 20 in L
  EXPECT_GT(squaredColorDifference(red, blue), 100 * 100);
}

TEST(ColorAgreement, FallsWithAGaussian) {
  EXPECT_EQ(colorAgreement(0, 20), 1);
  EXPECT_NEAR(colorAgreement(400, 20), 0.6065f, 1e-4);
  EXPECT_LT(colorAgreement(120 * 120, 20), 1e-6f);
}

TEST(ColorAgreement, PrintsVaryWhereTheirColorsMeet) {
  const TrainingView view = square(red, blue);
  const std::vector<float> variation = SurfaceWeights(view).shape_and_color;  // half of it: the square is flat
  ASSERT_EQ(variation.size(), view.surface_points.size());
  for (std::size_t i = 0; i < variation.size(); ++i) {
    const float x = view.surface_points[i].x();
    if (x < -0.0201f || x > 0.0251f) {
      EXPECT_LT(variation[i], 1e-6f);
    }
    if (std::abs(x) < 0.006f) {
      EXPECT_GT(variation[i], 0.25f);
    }
  }
  TrainingView plain = view;
  plain.surface_colors.clear();
  EXPECT_EQ(SurfaceWeights(plain).shape_and_color, SurfaceWeights(view).shape);
}

/// The object of the pose tests in colour, before a wall.
Surface coloredScene() {
  const Eigen::Isometry3f T = poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f});
  return prepared(view({{asymmetricShape(), T}}, 0.0025f, 240, 200, true));
}

TrainingView coloredView() {
  const Eigen::Isometry3f T = poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f});
  return train({sampleOf("thing", view({{asymmetricShape(), T}}, 0.0025f, 160, 120, true))}, Settings(), "test")
      .views[0];
}

PoseEvidence evidenceOf(const TrainingView& view, const Surface& surface, double tolerance) {
  Settings settings;
  settings.verification.color_tolerance = tolerance;
  return examinePose(view, SurfaceWeights(view), SceneView(surface, settings), settings, Eigen::Isometry3d::Identity());
}

TEST(ColorAgreement, AnObjectOfOtherColorsIsNotConfirmed) {
  const Surface scene = coloredScene();
  const TrainingView same = coloredView();
  ASSERT_EQ(same.surface_colors.size(), same.surface_points.size());
  TrainingView other = same;
  for (Eigen::Vector3f& color : other.surface_colors) color.tail<2>() = -color.tail<2>() + Eigen::Vector2f(0.5f, 0.5f);

  const PoseEvidence agreeing = evidenceOf(same, scene, 20), disagreeing = evidenceOf(other, scene, 20);
  EXPECT_GT(agreeing.weighted_supported, 0.85 * agreeing.weighted_visible);
  EXPECT_LT(disagreeing.supported, 0.5 * agreeing.supported);
  EXPECT_DOUBLE_EQ(disagreeing.facing, agreeing.facing);
  EXPECT_DOUBLE_EQ(evidenceOf(other, scene, 0).supported, evidenceOf(same, scene, 0).supported);
}

TEST(ColorAgreement, WithoutColorInTheSceneOnlyShapeCounts) {
  Surface scene = coloredScene();
  scene.color.clear();
  const TrainingView colored = coloredView();
  TrainingView plain = colored;
  plain.surface_colors.clear();
  EXPECT_DOUBLE_EQ(evidenceOf(colored, scene, 20).weighted_supported, evidenceOf(plain, scene, 20).weighted_supported);
}

}  // namespace
}  // namespace sks::test
