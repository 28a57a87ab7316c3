// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <sks_detector/error.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "simulation/distractors.hpp"
#include "simulation/pixel_random.hpp"
#include "simulation/scene_random.hpp"
#include "simulation/shapes.hpp"
#include "simulation/table_physics.hpp"

namespace sks {
namespace {

constexpr double table_thickness = 0.03;                   // [m]
constexpr std::uint64_t scene_stream = ~std::uint64_t(0);  // the pixels of the picture have the other streams
constexpr int most_tries = 20;                             // to drop a thing so that it stays on the table

/// Something to be dropped.
struct Thing {
  std::shared_ptr<const Mesh> mesh;
  int model;  // -1: a distractor
};

/// A rotation out of all with equal chances (Shoemake 1992).
Eigen::Quaterniond anyRotation(PixelRandom& random) {
  const double u = random.uniform(), v = 2 * EIGEN_PI * random.uniform(), w = 2 * EIGEN_PI * random.uniform();
  return {std::sqrt(u) * std::cos(w), std::sqrt(1 - u) * std::sin(v), std::sqrt(1 - u) * std::cos(v),
          std::sqrt(u) * std::sin(w)};
}

/// Which objects a scene holds: all different ones where there are enough of them.
std::vector<Thing> chooseThings(const std::vector<SceneModel>& models, const SceneOptions& options,
                                PixelRandom& random) {
  std::vector<Thing> things;
  std::vector<std::size_t> deck;
  for (int i = 0; i < options.objects; ++i) {
    if (deck.empty() || options.repeated) {
      deck.resize(models.size());
      for (std::size_t k = 0; k < deck.size(); ++k) deck[k] = k;
    }
    const auto card = deck.begin() + std::ptrdiff_t(below(random, deck.size()));
    things.push_back({models[*card].mesh, int(*card)});
    deck.erase(card);
  }
  for (int i = 0; i < options.distractors; ++i) {
    things.insert(
        things.begin() + std::ptrdiff_t(below(random, things.size() + 1)),
        {std::make_shared<const Mesh>(options.packages ? packageDistractor(random) : plainDistractor(random)), -1});
  }
  return things;
}

/// Where things come to lie; those that never stay on the table are taken out of the list.
std::vector<Eigen::Isometry3d> dropAll(std::vector<Thing>& things, const SceneOptions& options, PixelRandom& random) {
  TablePhysics physics(table_half);
  std::map<const Mesh*, std::unique_ptr<RigidBody>> bodies;
  std::vector<Thing> lying;
  for (const Thing& thing : things) {
    auto& body = bodies[thing.mesh.get()];
    if (!body) body = std::make_unique<RigidBody>(*thing.mesh);
    for (int attempt = 0; attempt < most_tries; ++attempt) {
      const double angle = 2 * EIGEN_PI * random.uniform(), radius = options.region * std::sqrt(random.uniform());
      const Eigen::Quaterniond rotation = anyRotation(random);
      if (!physics.drop(*body, radius * std::cos(angle), radius * std::sin(angle), rotation, options.region + 0.1))
        continue;
      lying.push_back(thing);
      break;
    }
  }
  things = std::move(lying);
  return physics.settle();
}

Eigen::Isometry3d placeCamera(const SceneOptions& options, PixelRandom& random) {
  const double distance = between(random, options.min_distance, options.max_distance);
  const double elevation = between(random, options.min_elevation, options.max_elevation) * EIGEN_PI / 180;
  const double azimuth = 2 * EIGEN_PI * random.uniform();
  const Eigen::Vector3d target(between(random, -0.03, 0.03), between(random, -0.03, 0.03), 0.04);
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                  std::sin(elevation));
  return lookAt(target + distance * direction, target, Eigen::Vector3d::UnitZ());
}

/// Table, and perhaps a wall on the side that is far from the camera.
void addPlainRoom(Renderer& renderer, const Eigen::Isometry3d& T_table_camera, const SceneOptions& options,
                  PixelRandom& random) {
  const auto add = [&](const Eigen::Vector3f& size, const Rgb& color, const Eigen::Isometry3d& pose) {
    renderer.addInstance(renderer.addMesh(std::make_shared<const Mesh>(makeBox(size, plain(color)))), pose);
  };
  add({float(2 * table_half), float(2 * table_half), float(table_thickness)}, anyColor(random, 90, 220),
      Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.5 * table_thickness)));
  const Rgb color = anyColor(random, 150, 240);
  if (random.uniform() >= options.wall_share) return;
  const double azimuth = std::atan2(T_table_camera.translation().y(), T_table_camera.translation().x());
  Eigen::Isometry3d pose(Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()));
  pose.translate(Eigen::Vector3d(-table_half, 0, 0.3));
  add({0.05f, 4, 2}, color, pose);
}

/// How many pixels each thing has in the picture. @param measured only those with a depth
std::vector<std::size_t> pixelCounts(const Rendering& view, std::size_t things, bool measured = false) {
  std::vector<std::size_t> counts(things, 0);
  for (std::size_t pixel = 0; pixel < view.instance.size(); ++pixel) {
    const std::int32_t i = view.instance[pixel];
    if (i < 0 || std::size_t(i) >= things || (measured && !view.cloud.points[pixel].allFinite())) continue;
    ++counts[std::size_t(i)];
  }
  return counts;
}

/// What fraction of each thing is not occluded by others.
std::vector<double> visibilities(Renderer& renderer, const std::vector<Thing>& things, const SceneOptions& options,
                                 const Eigen::Isometry3d& T_table_camera, const Rendering& view, std::size_t all) {
  CameraModel camera = options.camera;
  camera.noise = CameraNoise::none();
  camera.color = {};
  const std::vector<std::size_t> seen = pixelCounts(view, things.size());
  std::vector<double> result(things.size(), 0);
  for (std::size_t i = 0; i < all; ++i) renderer.setVisible(i, false);
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].model < 0 || seen[i] == 0) continue;
    renderer.setVisible(i, true);
    const Rendering alone = renderer.render(camera, T_table_camera, 0, options.threads);
    result[i] = double(seen[i]) / double(pixelCounts(alone, things.size())[i]);
    renderer.setVisible(i, false);
  }
  return result;
}

}  // namespace

void validate(const SceneOptions& options) {
  const auto check = [](bool good, const std::string& name, double value, const std::string& range) {
    if (good) return;
    throw Error(ErrorCode::bad_usage, "scene: " + name + " = " + std::to_string(value) + " must be " + range);
  };
  check(options.objects >= 0 && options.objects <= 100, "objects", options.objects, "in [0, 100]");
  check(options.distractors >= 0 && options.distractors <= 100, "distractors", options.distractors, "in [0, 100]");
  check(options.region > 0 && options.region <= 0.45, "region", options.region, "in (0, 0.45] m");
  check(options.wall_share >= 0 && options.wall_share <= 1, "wall_share", options.wall_share, "in [0, 1]");
  check(options.min_distance > 0, "min_distance", options.min_distance, "greater than 0 m");
  check(options.max_distance >= options.min_distance && options.max_distance <= 100, "max_distance",
        options.max_distance, "in [min_distance, 100] m");
  check(options.min_elevation > 0, "min_elevation", options.min_elevation, "greater than 0 degrees");
  check(options.max_elevation >= options.min_elevation && options.max_elevation <= 90, "max_elevation",
        options.max_elevation, "in [min_elevation, 90] degrees");
  validate(options.camera);
}

SimulatedScene simulateScene(const std::vector<SceneModel>& models, const SceneOptions& options, std::uint64_t number) {
  validate(options);
  if (models.empty() && options.objects > 0) throw Error(ErrorCode::bad_usage, "there are no models for the scene");
  PixelRandom random(options.seed, number, scene_stream);
  std::vector<Thing> things = chooseThings(models, options, random);
  const std::vector<Eigen::Isometry3d> T_table_thing = dropAll(things, options, random);

  SimulatedScene scene;
  scene.T_table_camera = placeCamera(options, random);
  Renderer renderer;
  std::map<const Mesh*, std::size_t> meshes;
  for (std::size_t i = 0; i < things.size(); ++i) {  // instances are numbered like the things
    const auto [mesh, fresh] = meshes.try_emplace(things[i].mesh.get(), 0);
    if (fresh) mesh->second = renderer.addMesh(things[i].mesh);
    renderer.addInstance(mesh->second, T_table_thing[i]);
  }
  if (options.room == Room::plain) addPlainRoom(renderer, scene.T_table_camera, options, random);
  if (options.room == Room::furnished) {
    renderer.addInstance(renderer.addMesh(std::make_shared<const Mesh>(patternedTable(options.seed, number))),
                         Eigen::Isometry3d::Identity());
    furnish(renderer, scene.T_table_camera, options.seed, number);
  }
  CameraModel camera = options.camera;
  camera.noise.seed = options.seed;
  scene.view = renderer.render(camera, scene.T_table_camera, number, options.threads);
  const std::vector<double> visible =
      visibilities(renderer, things, options, scene.T_table_camera, scene.view, renderer.instanceCount());
  const std::vector<std::size_t> points = pixelCounts(scene.view, things.size(), true);
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].model < 0) continue;
    scene.objects.push_back(
        {std::size_t(things[i].model), scene.T_table_camera.inverse() * T_table_thing[i], visible[i], points[i]});
  }
  return scene;
}

}  // namespace sks
