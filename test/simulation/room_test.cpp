// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/room.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sks_detector/simulation/camera_presets.hpp>

#include "error_of.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/distractors.hpp"
#include "simulation/scene.hpp"
#include "simulation/twin.hpp"

namespace sks {
namespace {

using ::testing::HasSubstr;

std::vector<SceneModel> mugAndDuck() {
  std::vector<SceneModel> models;
  for (const char* name : {"mug", "duck"}) {
    models.push_back({name, name, std::make_shared<const Mesh>(builtinObject(name))});
  }
  return models;
}

SceneOptions quickOptions(Room room) {
  SceneOptions options;
  options.objects = 2;
  options.distractors = 1;
  options.room = room;
  options.camera = cameraPreset("ideal");
  options.camera.width = 320;
  options.camera.height = 240;
  options.camera.fx = options.camera.fy = 262;
  options.camera.cx = 159.5;
  options.camera.cy = 119.5;
  options.min_elevation = 25;
  options.max_elevation = 30;
  return options;
}

/// Share of the pixels that see something so far behind.
double shareBeyond(const Cloud& cloud, float depth) {
  const auto count =
      std::count_if(cloud.points.begin(), cloud.points.end(), [&](const Eigen::Vector3f& p) { return p.z() > depth; });
  return double(count) / double(cloud.size());
}

TEST(Room, FurnishedOneReachesFarBehindTheSameTable) {
  const SimulatedScene plain = simulateScene(mugAndDuck(), quickOptions(Room::plain), 1);
  const SimulatedScene furnished = simulateScene(mugAndDuck(), quickOptions(Room::furnished), 1);
  ASSERT_EQ(plain.objects.size(), furnished.objects.size());
  for (std::size_t i = 0; i < plain.objects.size(); ++i) {
    EXPECT_EQ(plain.objects[i].T_camera_model.matrix(), furnished.objects[i].T_camera_model.matrix());
    EXPECT_EQ(plain.objects[i].visibility, furnished.objects[i].visibility);
  }
  EXPECT_GT(shareBeyond(furnished.view.cloud, 1.8f), 0.1);
  EXPECT_GT(shareBeyond(furnished.view.cloud, 1.8f), shareBeyond(plain.view.cloud, 1.8f));
  const SimulatedScene none = simulateScene(mugAndDuck(), quickOptions(Room::none), 1);
  EXPECT_EQ(shareBeyond(none.view.cloud, 1.8f), 0);
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [] { roomOf("kitchen"); }),
              HasSubstr("no room 'kitchen': use one of none, plain, furnished"));
}

TEST(Room, PackagesHaveSizesAndPrintsOfPackages) {
  for (std::uint64_t i = 0; i < 30; ++i) {
    PixelRandom random(1, i, 0);
    const Mesh mesh = packageDistractor(random);
    EXPECT_GE(mesh.box().sizes().maxCoeff(), 0.035f);
    EXPECT_LE(mesh.box().sizes().maxCoeff(), 0.27f);
    ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
    const auto different = std::count_if(mesh.colors.begin(), mesh.colors.end(), [&](const Rgb& c) {
      return c.r != mesh.colors[0].r || c.g != mesh.colors[0].g;
    });
    EXPECT_GT(different, std::ptrdiff_t(mesh.colors.size() / 50));
  }
}

TEST(Twin, IsTheRecordingWithTheMeshesInThePlaceOfTheObjects) {
  const SceneOptions options = quickOptions(Room::furnished);
  const std::vector<SceneModel> models = mugAndDuck();
  SimulatedScene scene = simulateScene(models, options, 1);
  Cloud recording = scene.view.cloud;
  for (Rgb& c : recording.colors) c = {std::uint8_t(c.r / 2), std::uint8_t(c.g / 2), std::uint8_t(c.b / 2)};
  std::vector<TwinObject> objects;
  for (const ScenePlacement& placed : scene.objects) {
    objects.push_back({models[placed.model].mesh, placed.T_camera_model});
  }

  const Twin exact = makeTwin(recording, objects, cameraPreset("ideal"), 0, 2);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    EXPECT_NEAR(double(exact.points[i]), double(scene.objects[i].points), 0.05 * double(scene.objects[i].points) + 5);
  }
  std::size_t true_colors = 0, on_object = 0;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const std::int32_t thing = scene.view.instance[i];
    if (!recording.points[i].allFinite() || !exact.cloud.points[i].allFinite()) continue;
    EXPECT_NEAR(exact.cloud.points[i].z(), recording.points[i].z(), 0.002f);
    if (exact.cloud.colors[i].g == recording.colors[i].g) continue;
    ++on_object;
    true_colors += thing >= 0 && exact.cloud.colors[i].g == scene.view.cloud.colors[i].g ? 1 : 0;
  }
  EXPECT_GT(on_object, 500u);
  EXPECT_GT(double(true_colors), 0.95 * double(on_object));

  CameraModel exposed = cameraPreset("ideal");
  exposed.color.max_exposure = 1;  // takes the recording's exposure in place of a random one
  const Twin fitted = makeTwin(recording, objects, exposed, 0, 2);
  double error = 0;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    error += std::abs(double(fitted.cloud.colors[i].g) - double(recording.colors[i].g));
  }
  EXPECT_LT(error / double(on_object), 8);

  recording.height = 1;
  recording.width = std::uint32_t(recording.size());
  EXPECT_THAT(test::errorOf(ErrorCode::bad_data, [&] { makeTwin(recording, objects, exposed, 0, 2); }),
              HasSubstr("needs an organised cloud"));
}

}  // namespace
}  // namespace sks
