// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/model_surface.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace sks {
namespace {

TrainingView viewOf(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& color) {
  TrainingView view;
  view.frame = "cup#model";
  view.surface_points = points;
  view.surface_normals.assign(points.size(), Eigen::Vector3f::UnitZ());
  view.surface_colors.assign(points.size(), color);
  view.sensor_origin = {0, 0, 1};
  return view;
}

/// Two views of one frame that share a point.
Codebook twoViews() {
  Codebook codebook;
  codebook.objects = {"cup"};
  codebook.views = {viewOf({{0, 0, 0}, {0.1f, 0, 0}}, {0.2f, 0, 0}),
                    viewOf({{0.1f, 0, 0}, {0.2f, 0, 0}}, {0.9f, 0, 0})};
  return codebook;
}

TEST(AveragedSurface, IsTheUnionOfTheViewsOfAFrame) {
  const auto surfaces = modelSurfaces(twoViews());
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0], surfaces[1]);
  EXPECT_EQ(surfaces[0]->points.size(), 3u);
  EXPECT_EQ(surfaces[0]->colors.size(), 3u);
  EXPECT_EQ(surfaces[0]->views, (std::vector<std::uint32_t>{0, 1}));
}

TEST(AveragedSurface, OfRegisteredViewsIsTheirAveragedModel) {
  Codebook codebook = twoViews();
  RegisteredModel model;
  model.frame = "cup#model";
  model.surface.points = {{0, 0, 0.001f}, {0.1f, 0, 0}};
  model.surface.normals = {Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX()};
  model.surface.colors = {{255, 255, 255}, {0, 0, 0}};
  codebook.models = {model};
  const auto surfaces = modelSurfaces(codebook);
  EXPECT_EQ(surfaces[0], surfaces[1]);
  EXPECT_EQ(surfaces[0]->points, model.surface.points);
  EXPECT_EQ(surfaces[0]->normals, model.surface.normals);
  ASSERT_EQ(surfaces[0]->colors.size(), 2u);
  EXPECT_NEAR(surfaces[0]->colors[0].x(), 1, 1e-3);  // lightness
  EXPECT_NEAR(surfaces[0]->colors[1].x(), 0, 1e-3);
  EXPECT_EQ(surfaces[0]->directions.size(), 2u);
}

}  // namespace
}  // namespace sks
