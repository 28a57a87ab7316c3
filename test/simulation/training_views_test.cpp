// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/training_views.hpp>

#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

#include "error_of.hpp"
#include "simulation/renderer.hpp"
#include "simulation/shapes.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

TEST(MeshSamples, AreRegisteredInTheFrameOfTheMesh) {
  const auto mesh = std::make_shared<const Mesh>(transformed(makeBox({0.1f, 0.06f, 0.2f}, plain({9, 8, 7}), 0.05f),
                                                             Eigen::Isometry3f(Eigen::Translation3f(1, 2, 3))));
  MeshTraining training;
  training.views = 12;
  const auto samples = meshSamples("box", "box.obj", mesh, training);
  ASSERT_EQ(samples.size(), 12u);
  Eigen::AlignedBox3f seen;
  for (const TrainingSample& sample : samples) {
    EXPECT_EQ(sample.frame, "box.obj");
    EXPECT_TRUE(sample.box->isApprox(mesh->box()));
    const Cloud cloud = sample.load();
    EXPECT_NEAR((cloud.sensor_origin - mesh->box().center()).norm(), 0.8f, 1e-4f);
    EXPECT_EQ(cloud.colors.at(0).g, 8);
    for (const Eigen::Vector3f& p : cloud.points) seen.extend(p);
  }
  EXPECT_EQ(samples[3].source, "box.obj#3");
  EXPECT_LT((seen.min() - mesh->box().min()).norm(), 0.004f);
  EXPECT_LT((seen.max() - mesh->box().max()).norm(), 0.004f);
}

// What renders them is let go when each has been loaded once.
TEST(MeshSamples, MayBeLoadedAgainAndInAnyOrder) {
  MeshTraining training;
  training.views = 4;
  const auto mesh = std::make_shared<const Mesh>(makeBox({0.1f, 0.06f, 0.2f}, plain({9, 8, 7}), 0.05f));
  const auto samples = meshSamples("box", "box.obj", mesh, training);
  std::vector<Cloud> first;
  for (const TrainingSample& sample : samples) first.push_back(sample.load());
  for (const std::size_t i : {3u, 3u, 0u, 1u, 2u, 0u}) EXPECT_EQ(samples[i].load().points, first[i].points) << i;
}

// So that of many meshes only those in work take memory.
TEST(MeshSamples, LoadTheMeshForTheFirstViewAndLetItGoWithTheLast) {
  MeshTraining training;
  training.views = 4;
  const Mesh box = makeBox({0.1f, 0.06f, 0.2f}, plain({9, 8, 7}), 0.05f);
  int loaded = 0;
  std::weak_ptr<const Mesh> current;
  const auto load = [&] {
    ++loaded;
    const auto mesh = std::make_shared<const Mesh>(box);
    current = mesh;
    return mesh;
  };
  const auto samples = meshSamples("box", "box.obj", box, load, training);
  const auto kept = meshSamples("box", "box.obj", std::make_shared<const Mesh>(box), training);
  EXPECT_EQ(loaded, 0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].load().points, kept[i].load().points);
    EXPECT_EQ(loaded, 1);
    EXPECT_EQ(current.expired(), i + 1 == samples.size());
  }
  samples.front().load();
  EXPECT_EQ(loaded, 2) << "again";
}

TEST(MeshSamples, PassOnWhyTheMeshCannotBeLoaded) {
  const Mesh box = makeBox({0.1f, 0.06f, 0.2f}, plain({9, 8, 7}), 0.05f);
  const auto load = []() -> std::shared_ptr<const Mesh> { throw Error(ErrorCode::bad_file, "box.obj: it is gone"); };
  const auto samples = meshSamples("box", "box.obj", box, load, {});
  for (int i = 0; i < 2; ++i) {
    EXPECT_THAT(test::errorOf(ErrorCode::bad_file, [&] { samples.front().load(); }), HasSubstr("it is gone"));
  }
}

// Only the part of the image in which the mesh lies is rendered.
TEST(MeshSamples, ShowWhatTheWholeImageShows) {
  MeshTraining training;
  training.views = 12;
  const auto mesh = std::make_shared<const Mesh>(makeBox({0.3f, 0.02f, 0.5f}, plain({9, 8, 7}), 0.05f));
  CameraModel camera = training.camera;
  camera.noise = CameraNoise::none();
  camera.min_range = 0;
  for (const TrainingSample& sample : meshSamples("box", "box.obj", mesh, training)) {
    const Cloud cloud = sample.load();
    Renderer renderer;
    renderer.addInstance(renderer.addMesh(mesh), Eigen::Isometry3d::Identity());
    const Eigen::Isometry3d T_model_camera =
        lookAt(cloud.sensor_origin.cast<double>(), mesh->box().center().cast<double>(), Eigen::Vector3d::UnitZ());
    std::size_t seen = 0;
    for (const Eigen::Vector3f& p : renderer.render(camera, T_model_camera, 0, 1).cloud.points) seen += p.allFinite();
    EXPECT_EQ(cloud.size(), seen);
  }
}

TEST(MeshSamples, CameraThatLooksPastItsImageSeesNothing) {
  const auto mesh = std::make_shared<const Mesh>(makeBox({0.1f, 0.06f, 0.2f}, plain({9, 8, 7}), 0.05f));
  for (const double center : {-5000.0, 5000.0}) {
    MeshTraining training;
    training.camera.cx = center;
    EXPECT_EQ(meshSamples("box", "box.obj", mesh, training).front().load().size(), 0u);
  }
}

TEST(MeshSamples, MeshWithoutColourGivesViewsWithoutColour) {
  Mesh mesh = makeSphere(0.05f, 3, plain({}));
  mesh.colors.clear();
  EXPECT_FALSE(meshSamples("ball", "ball.stl", std::make_shared<const Mesh>(mesh), {}).front().load().hasColor());
}

}  // namespace
}  // namespace sks
