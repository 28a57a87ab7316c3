// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/sight_lines.hpp"

#include <gtest/gtest.h>

#include "core/verification/model_surface.hpp"
#include "prepared.hpp"
#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::test {
namespace {

const Shape small_box{{Solid::Shape::box, {0, 0, 0}, {0.06f, 0.04f, 0.03f}}};
/// Its front is no plane larger than the small box, which would say nothing.
const Shape large_box{{Solid::Shape::box, {0, 0, 0}, {0.11f, 0.059f, 0.03f}}};
const Eigen::Isometry3f T_camera_box = poseOf(0, {0, 0, 1}, {0, 0, 0.8f});

/// A box before a wall; perhaps with something nearer to the camera.
Surface boxScene(const Shape& box, const Shape& before = {}) {
  std::vector<Placed> placed{{box, T_camera_box}};
  placed.push_back({{{Solid::Shape::box, {0, 0, 0}, {0.8f, 0.8f, 0.01f}}}, poseOf(0, {0, 0, 1}, {0, 0, 1.2f})});
  if (!before.empty()) placed.push_back({before, poseOf(0, {0, 0, 1}, {0, 0, 0.5f})});
  return prepared(view(placed, 0.0025f, 240, 200));
}

/// The small box from all around.
const Codebook& boxCodebook() {
  static const Codebook codebook =
      train({sampleOf("box", model(small_box, 0.003f), ViewKind::model)}, Settings(), "synthetic");
  return codebook;
}

SightLines linesAt(const Surface& scene, const Eigen::Isometry3d& T_scene_model) {
  const Settings settings;
  return lookAlongRays(*modelSurfaces(boxCodebook()).at(0), SceneView(scene, settings), settings.verification,
                       T_scene_model, 0.12f);
}

Eigen::Isometry3d boxPose(double dx = 0, double dz = 0) {
  return Eigen::Translation3d(dx, 0, dz) * T_camera_box.cast<double>();
}

TEST(SightLines, TheTruePoseAgrees) {
  const SightLines lines = linesAt(boxScene(small_box), boxPose());
  EXPECT_GT(lines.confirmed, 200);
  EXPECT_LT(lines.missed, 0.25 * lines.confirmed);  // rays at the edges have no normal of one side
  EXPECT_GT(lines.ends, 5);
  EXPECT_EQ(lines.goes_on, 0);
  EXPECT_GT(lines.agreement(), 0.7);
  EXPECT_LE(lines.agreement(), 1);
}

TEST(SightLines, ASmallBoxOnALargeFaceGoesOnWhereTheModelEnds) {
  const SightLines lines = linesAt(boxScene(large_box), boxPose());
  EXPECT_GT(lines.confirmed, 200);  // every point of its front finds the large face
  EXPECT_GT(lines.goes_on, 4);
  EXPECT_EQ(lines.ends, 0);
  EXPECT_LT(lines.agreement(), 0.1);
}

TEST(SightLines, AnOutlineBehindSomethingSaysNothing) {
  const Shape board{{Solid::Shape::box, {0.1f, 0, 0}, {0.1f, 0.3f, 0.005f}}};  // before the right half
  const SightLines free = linesAt(boxScene(small_box), boxPose());
  const SightLines half = linesAt(boxScene(small_box, board), boxPose());
  EXPECT_LT(half.confirmed, 0.8 * free.confirmed);
  EXPECT_LT(half.goes_on, 0.15 * half.ends);
  EXPECT_GT(half.agreement(), 0.6);
}

TEST(SightLines, RaysThatPassThroughTheModelAreMissed) {
  const SightLines lines = linesAt(boxScene(small_box), boxPose(0, -0.1));
  EXPECT_EQ(lines.confirmed, 0);
  EXPECT_GT(lines.missed, 100);
  EXPECT_LT(lines.agreement(), 0.05);
}

TEST(SightLines, BehindTheSensorNothingIsSeen) {
  const SightLines lines = linesAt(boxScene(small_box), boxPose(0, -2));
  EXPECT_EQ(lines.confirmed + lines.missed, 0);
  EXPECT_EQ(lines.ends + lines.goes_on, 0);
}

TEST(SightLines, TheSensorInsideOfTheModelIsNoError) {
  const SightLines lines = linesAt(boxScene(small_box), boxPose(0, -0.8));
  EXPECT_GE(lines.missed, 0);
}

TEST(SightLines, SeesTheShiftOfColours) {
  const auto colored = [](Cloud cloud, std::uint8_t level) {
    cloud.colors.assign(cloud.points.size(), Rgb{level, level, level});
    return cloud;
  };
  const Codebook codebook =
      train({sampleOf("box", colored(model(small_box, 0.003f), 119), ViewKind::model)}, Settings(), "synthetic");
  const Cloud brighter = colored(view({{small_box, T_camera_box}}, 0.0025f, 240, 200), 150);
  const Surface scene = prepared(brighter);
  const Settings settings;
  const SightLines lines = lookAlongRays(*modelSurfaces(codebook).at(0), SceneView(scene, settings),
                                         settings.verification, boxPose(), 0.12f);
  ASSERT_TRUE(lines.color_shift);
  EXPECT_NEAR(lines.color_shift->x(), 0.12f, 0.02f);  // lightness 50 and 62
  EXPECT_NEAR(lines.color_shift->y(), 0, 0.01f);
  EXPECT_NEAR(lines.color_shift->z(), 0, 0.01f);
  EXPECT_FALSE(linesAt(boxScene(small_box), boxPose()).color_shift);
}

TEST(ModelSurface, ViewsOfOneFrameShareOneSurface) {
  Codebook codebook;
  codebook.objects = {"a", "b"};
  codebook.settings.training.surface_resolution = 0.005;
  const auto add = [&](std::uint32_t object, const std::string& frame, std::vector<Eigen::Vector3f> points) {
    TrainingView view;
    view.object = object;
    view.source = "view" + std::to_string(codebook.views.size());
    view.frame = frame;
    view.surface_normals.assign(points.size(), Eigen::Vector3f(0, 0, -1));
    view.surface_points = std::move(points);
    codebook.views.push_back(view);
  };
  add(0, "mesh", {{0.001f, 0, 0}, {0.02f, 0, 0}});
  add(0, "mesh", {{0.002f, 0, 0}, {0.04f, 0, 0}});
  add(0, "", {{0.001f, 0, 0}});
  add(1, "mesh", {{0.001f, 0, 0}});
  const auto surfaces = modelSurfaces(codebook);
  ASSERT_EQ(surfaces.size(), 4u);
  EXPECT_EQ(surfaces[0], surfaces[1]);
  EXPECT_EQ(surfaces[0]->points.size(), 3u);  // the first points of both lie in one cube
  EXPECT_EQ(surfaces[0]->views, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(surfaces[2]->points.size(), 1u);
  EXPECT_NE(surfaces[3], surfaces[0]);
}

TEST(ModelSurface, FrontAndBackOfAThinPartStayApart) {
  Codebook codebook;
  codebook.objects = {"leaf"};
  codebook.settings.training.surface_resolution = 0.005;
  TrainingView view;
  view.surface_points = {{0.001f, 0, 0.001f}, {0.001f, 0, 0.002f}};
  view.surface_normals = {{0, 0, -1}, {0, 0, 1}};
  codebook.views = {view};
  EXPECT_EQ(modelSurfaces(codebook).at(0)->points.size(), 2u);
}

}  // namespace
}  // namespace sks::test
