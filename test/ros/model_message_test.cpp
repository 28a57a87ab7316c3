// SPDX-License-Identifier: BSD-3-Clause
#include "ros/model_message.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/surface/color_space.hpp"
#include "ros/cloud_message.hpp"

namespace sks_detector {
namespace {

constexpr sks::Rgb red{200, 10, 10};

/// A square at z; lengths in metres.
sks::TrainingView square(std::uint32_t object, const std::string& frame, float edge, float z, float step = 0.001F) {
  sks::TrainingView view;
  view.object = object;
  view.source = "view of " + frame;
  view.frame = frame;
  const auto lab = sks::toScaledLab(red);
  const int count = int(std::lround(edge / step));
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      view.surface_points.emplace_back(float(i) * step, float(j) * step, z);
      view.surface_normals.emplace_back(0, 0, 1);
      view.surface_colors.emplace_back(lab[0], lab[1], lab[2]);
    }
  }
  view.box_min = Eigen::Vector3f(0, 0, z);
  view.box_max = Eigen::Vector3f(edge, edge, z);
  return view;
}

Eigen::AlignedBox3f boxOf(const sks::Cloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : cloud.points) box.extend(point);
  return box;
}

}  // namespace

TEST(ModelMessage, HoldsEachFrameOfEachObjectOnce) {
  sks::Codebook codebook;
  codebook.objects = {"cup", "box"};
  codebook.views = {square(0, "cup", 0.1F, 0.5F), square(1, "", 0.05F, 1), square(0, "cup", 0.1F, 0.6F)};
  const ObjectModels message = toModels(codebook, "toys (1)");
  EXPECT_EQ(message.codebook, "toys (1)");
  ASSERT_EQ(message.models.size(), 2U);
  EXPECT_EQ(message.models[0].object, "cup");
  EXPECT_EQ(message.models[0].view, "cup");
  EXPECT_EQ(message.models[1].object, "box");
  EXPECT_EQ(message.models[1].view, "view of ") << "of its own frame";

  const sks::Cloud cup = toCloud(message.models[0].points);
  EXPECT_FLOAT_EQ(message.models[0].spacing, 0.005F);
  EXPECT_NEAR(double(cup.size()), 2 * 20 * 20, 100) << "both views, 5 mm apart";
  EXPECT_NEAR(boxOf(cup).min().z(), 0.5, 1e-6);
  EXPECT_NEAR(boxOf(cup).max().z(), 0.6, 1e-6);
  EXPECT_NEAR(boxOf(cup).sizes().x(), 0.1, 0.006);
  ASSERT_TRUE(cup.hasColor());
  EXPECT_NEAR(cup.colors[0].r, red.r, 1);
  EXPECT_NEAR(cup.colors[0].g, red.g, 1);
}

TEST(ModelMessage, RegisteredModelsAreTakenAsTheyWereFused) {
  sks::Codebook codebook;
  codebook.objects = {"cup"};
  codebook.views = {square(0, "cup", 0.1F, 0.5F)};
  sks::RegisteredModel model;
  model.frame = "cup";
  model.surface.points = {Eigen::Vector3f(1, 2, 3)};
  model.surface.normals = {Eigen::Vector3f::UnitZ()};
  codebook.models = {model};
  const ObjectModels message = toModels(codebook, "");
  ASSERT_EQ(message.models.size(), 1U);
  const sks::Cloud cloud = toCloud(message.models[0].points);
  ASSERT_EQ(cloud.size(), 1U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_FALSE(cloud.hasColor());
}

TEST(ModelMessage, LargeModelsAreThinnedMore) {
  sks::Codebook codebook;
  codebook.objects = {"table"};
  codebook.views = {square(0, "table", 0.5F, 1)};
  const ObjectModels message = toModels(codebook, "");
  const ObjectModel& model = message.models.at(0);
  EXPECT_GT(model.spacing, 0.009F);
  EXPECT_LE(model.points.width, 3000U);
  EXPECT_GE(model.points.width, 1000U);
  EXPECT_NEAR(boxOf(toCloud(model.points)).sizes().x(), 0.5, 0.03);
}

TEST(ModelMessage, ManyModelsStayBelowEightMegabytes) {
  sks::Codebook codebook;
  codebook.objects = {"thing"};
  for (int i = 0; i < 400; ++i) codebook.views.push_back(square(0, std::to_string(i), 0.2F, 1, 0.004F));
  const ObjectModels message = toModels(codebook, "");
  ASSERT_EQ(message.models.size(), 400U);
  std::size_t bytes = 0;
  for (const ObjectModel& model : message.models) {
    bytes += model.points.data.size();
    EXPECT_GE(model.points.width, 500U);
  }
  EXPECT_LE(bytes, 8'000'000U);
}

TEST(ModelMessage, AnEmptyCodebookHasNoModels) {
  EXPECT_TRUE(toModels(sks::Codebook(), "").models.empty());
}

}  // namespace sks_detector
