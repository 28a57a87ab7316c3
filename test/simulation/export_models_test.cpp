// SPDX-License-Identifier: BSD-3-Clause
// `sks train` with captured views: models as files, what it says of views.
#ifdef SKS_EXECUTABLE  // not where the command line is left out of the build

#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/simulation/camera_presets.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "core/capture/tabletop.hpp"
#include "io/captured_views.hpp"
#include "run_sks.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"
#include "temporary_folder.hpp"

namespace sks {
namespace {

using test::runSks;
using ::testing::HasSubstr;

/// Views of the built-in duck, 30 degrees apart, as ~capture_view stores them.
void captureDuck(const std::string& folder, int views) {
  const auto mesh = std::make_shared<const Mesh>(builtinObject("duck"));
  const auto table = std::make_shared<const Mesh>(makeBox({1, 1, 0.02f}, plain({150, 140, 130}), 0.02f));
  Renderer renderer;
  renderer.addInstance(renderer.addMesh(table), Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.01)));
  renderer.addInstance(renderer.addMesh(mesh), Eigen::Isometry3d::Identity());
  CapturedViews captured(folder);
  for (int i = 0; i < views; ++i) {
    const double turn = i * 30 * EIGEN_PI / 180;
    const Eigen::Vector3d eye(0.6 * std::cos(turn), 0.6 * std::sin(turn), 0.5), target(0, 0, 0.05);
    const Cloud picture =
        renderer.render(cameraPreset("kinect"), lookAt(eye, target, Eigen::Vector3d::UnitZ()), std::uint64_t(i), 2)
            .cloud;
    const Tabletop top = findTabletop(picture);
    captured.add("duck", cutOut(picture, top.objects.at(0)), top.plane.cast<double>());
  }
}

TEST(ExportModels, WritesCloudAndMesh) {
  const test::TemporaryFolder folder;
  captureDuck(folder.path("captured"), 5);
  const test::CommandRun run = runSks({"train", "--dataset", folder.path("captured/dataset.yaml"), "--output",
                                       folder.path("a.sks"), "--export-models", folder.path("models"), "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.errors;
  const auto json = nlohmann::json::parse(run.output);
  ASSERT_EQ(json["registration"].size(), 1u);
  EXPECT_GE(json["registration"][0]["tied"], 4);
  EXPECT_EQ(json["registration"][0]["views"][1]["pose"].size(), 16u);
  EXPECT_EQ(json["models"].size(), 2u);
  const Cloud cloud = readCloud(folder.path("models/duck.ply"));
  EXPECT_EQ(cloud.size(), json["registration"][0]["points"]);
  EXPECT_TRUE(cloud.hasColor());
  const LoadedMesh loaded = loadMesh(folder.path("models/duck_mesh.ply"), 1);
  EXPECT_GT(loaded.mesh.triangles.size(), 1000u);
  EXPECT_TRUE(loaded.mesh.hasColor());
  EXPECT_LT((loaded.mesh.box().sizes() - builtinObject("duck").box().sizes()).norm(), 0.1f);

  // The codebook holds the same model, thinned.
  const test::CommandRun info =
      runSks({"info", folder.path("a.sks"), "--export-models", folder.path("held"), "--json", "-"});
  ASSERT_EQ(info.status, 0) << info.errors;
  const auto held = nlohmann::json::parse(info.output);
  EXPECT_EQ(held["models"].size(), 2u);
  EXPECT_EQ(held["objects"][0]["model"]["frame"], "duck#model");
  EXPECT_EQ(held["objects"][0]["model"]["box_max"], json["registration"][0]["box_max"]);
  const Cloud thinned = readCloud(folder.path("held/duck.ply"));
  EXPECT_EQ(thinned.size(), held["objects"][0]["model"]["points"]);
  EXPECT_LT(thinned.size(), cloud.size() / 2);
  EXPECT_GT(thinned.size(), 500u);
  EXPECT_TRUE(thinned.hasColor());
  EXPECT_GT(loadMesh(folder.path("held/duck_mesh.ply"), 1).mesh.triangles.size(), 1000u);
}

TEST(ExportModels, SaysWhereThereIsNone) {
  const test::TemporaryFolder folder;
  captureDuck(folder.path("captured"), 2);
  const test::CommandRun run = runSks({"train", "--dataset", folder.path("captured/dataset.yaml"), "--output",
                                       folder.path("a.sks"), "--export-models", folder.path("models")});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.errors, HasSubstr("two views alone cannot confirm each other"));
  EXPECT_THAT(run.errors, HasSubstr("no model to export"));
  const test::CommandRun info = runSks({"info", folder.path("a.sks"), "--export-models", folder.path("held")});
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.errors, HasSubstr("no model to export"));
}

}  // namespace
}  // namespace sks

#endif
