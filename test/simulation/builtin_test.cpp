// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/builtin_objects.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.hpp"
#include "simulation/scene.hpp"

namespace sks {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Extents of a built-in object, the smallest first [mm].
Eigen::Vector3f sortedSize(const std::string& name) {
  Eigen::Vector3f size = 1000 * builtinObject(name).box().sizes();
  std::sort(size.data(), size.data() + 3);
  return size;
}

/// The colours of a mesh that cover more than a fiftieth of its vertices.
std::set<std::tuple<int, int, int>> mainColors(const Mesh& mesh) {
  std::map<std::tuple<int, int, int>, std::size_t> counts;
  for (const Rgb& c : mesh.colors) ++counts[{c.r, c.g, c.b}];
  std::set<std::tuple<int, int, int>> colors;
  for (const auto& [color, count] : counts) {
    if (50 * count > mesh.colors.size()) colors.insert(color);
  }
  return colors;
}

TEST(BuiltinGroups, AreOfTheirSizes) {
  EXPECT_THAT(builtinGroups(), ElementsAre("household", "small", "flat", "thin"));
  EXPECT_THAT(builtinNames("small"), ElementsAre("dice", "ball", "matchbox", "spool", "pawn"));
  EXPECT_THAT(builtinNames("flat"), ElementsAre("card", "coaster", "tile", "booklet", "tablet"));
  EXPECT_THAT(builtinNames("thin"), ElementsAre("marker", "screwdriver", "brush", "spoon", "stick"));
  for (const std::string& name : builtinNames("small")) {
    const Eigen::Vector3f size = sortedSize(name);
    EXPECT_GE(size[1], 26) << name;
    EXPECT_GE(size[2], 30) << name;
    EXPECT_LE(size[2], 40.1) << name;
  }
  for (const std::string& name : builtinNames("flat")) {
    const Eigen::Vector3f size = sortedSize(name);
    EXPECT_NEAR(size[0], 6, 0.01) << name;
    EXPECT_GE(size[1], 49.9) << name;
    EXPECT_LE(size[2], 200.1) << name;
  }
  for (const std::string& name : builtinNames("thin")) {
    const Eigen::Vector3f size = sortedSize(name);
    EXPECT_NEAR(size[0], 13, 0.1) << name;
    EXPECT_LE(size[1], 41) << name;
    EXPECT_GE(size[2], 149.9) << name;
    EXPECT_LE(size[2], 400.1) << name;
  }
  EXPECT_THAT(test::errorOf(ErrorCode::bad_usage, [] { builtinNames("tiny"); }),
              HasSubstr("no group 'tiny' of built-in objects: use one of household, small, flat, thin"));
}

TEST(BuiltinGroups, StandOnTheGroundAndArePrintedDifferently) {
  std::set<std::set<std::tuple<int, int, int>>> palettes;
  std::size_t count = 0;
  for (const std::string& group : builtinGroups()) {
    for (const std::string& name : builtinNames(group)) {
      const Mesh mesh = builtinObject(name);
      ASSERT_EQ(mesh.colors.size(), mesh.vertices.size()) << name;
      EXPECT_NEAR(mesh.box().min().z(), 0, 0.003f) << name;
      EXPECT_GE(mainColors(mesh).size(), 2u) << name;
      palettes.insert(mainColors(mesh));
      ++count;
    }
  }
  EXPECT_EQ(palettes.size(), count);
}

TEST(BuiltinGroups, FrontAndBackOfFlatOnesDiffer) {
  const Mesh mesh = builtinObject("booklet");
  const auto colorAt = [&](float x, float y, float z) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      if ((mesh.vertices[i] - Eigen::Vector3f(x, y, z)).norm() <
          (mesh.vertices[nearest] - Eigen::Vector3f(x, y, z)).norm()) {
        nearest = i;
      }
    }
    return mesh.colors[nearest];
  };
  const Rgb title = colorAt(0.06f, 0.08f, 0.006f), back = colorAt(0.06f, 0.08f, 0);
  EXPECT_EQ(std::make_tuple(title.r, title.g, title.b), std::make_tuple(190, 40, 50));
  EXPECT_EQ(std::make_tuple(back.r, back.g, back.b), std::make_tuple(245, 235, 210));
}

TEST(BuiltinGroups, PointsAreWhatIsMeasuredOnThem) {
  std::vector<SceneModel> models;
  for (const std::string& name : builtinNames("flat")) {
    models.push_back({name, "builtin:" + name, std::make_shared<const Mesh>(builtinObject(name))});
  }
  SceneOptions options;
  options.distractors = 0;
  options.min_distance = 0.6;
  options.max_distance = 1.0;
  options.camera.noise = CameraNoise::none();
  const SimulatedScene scene = simulateScene(models, options, 0);
  ASSERT_EQ(scene.objects.size(), 5u);
  std::size_t all = 0;
  for (const ScenePlacement& placed : scene.objects) {
    const Eigen::AlignedBox3d box = models[placed.model].mesh->box().cast<double>();
    const Eigen::AlignedBox3d wider(box.min().array() - 0.0002, box.max().array() + 0.0002);
    const Eigen::Isometry3d T_model_camera = placed.T_camera_model.inverse();
    std::size_t inside = 0;
    for (const Eigen::Vector3f& p : scene.view.cloud.points) {
      if (p.allFinite() && wider.contains(T_model_camera * p.cast<double>())) ++inside;
    }
    EXPECT_GE(placed.points, 0.7 * double(inside)) << models[placed.model].object;
    EXPECT_LE(placed.points, inside) << models[placed.model].object;
    all += placed.points;
  }
  EXPECT_GT(all, 3000u);

  options.camera.noise = CameraNoise();
  const SimulatedScene noisy = simulateScene(models, options, 0);
  ASSERT_EQ(noisy.objects.size(), scene.objects.size());
  for (std::size_t i = 0; i < noisy.objects.size(); ++i) EXPECT_LE(noisy.objects[i].points, scene.objects[i].points);
}

}  // namespace
}  // namespace sks
