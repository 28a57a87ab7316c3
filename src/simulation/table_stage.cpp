// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/table_stage.hpp"

#include <cmath>
#include <map>
#include <utility>

#include <sks_detector/error.hpp>

#include "simulation/distractors.hpp"
#include "simulation/scene_random.hpp"
#include "simulation/shapes.hpp"
#include "simulation/table_physics.hpp"

namespace sks {
namespace {

constexpr double table_thickness = 0.03;                   // [m]
constexpr std::uint64_t scene_stream = ~std::uint64_t(0);  // the pixels of the picture have the other streams
constexpr int most_tries = 20;                             // to drop a thing so that it stays on the table

/// A rotation out of all with equal chances (Shoemake 1992).
Eigen::Quaterniond anyRotation(PixelRandom& random) {
  const double u = random.uniform(), v = 2 * EIGEN_PI * random.uniform(), w = 2 * EIGEN_PI * random.uniform();
  return {std::sqrt(u) * std::cos(w), std::sqrt(1 - u) * std::sin(v), std::sqrt(1 - u) * std::cos(v),
          std::sqrt(u) * std::sin(w)};
}

/// Which objects a scene holds: all different ones where there are enough of them.
std::vector<TableThing> chooseThings(const std::vector<SceneModel>& models, const SceneOptions& options,
                                     PixelRandom& random) {
  std::vector<TableThing> things;
  std::vector<std::size_t> deck;
  for (int i = 0; i < options.objects; ++i) {
    if (deck.empty() || options.repeated) {
      deck.resize(models.size());
      for (std::size_t k = 0; k < deck.size(); ++k) deck[k] = k;
    }
    const auto card = deck.begin() + std::ptrdiff_t(below(random, deck.size()));
    things.push_back({models[*card].mesh, int(*card), Eigen::Isometry3d::Identity()});
    deck.erase(card);
  }
  for (int i = 0; i < options.distractors; ++i) {
    things.insert(things.begin() + std::ptrdiff_t(below(random, things.size() + 1)),
                  {std::make_shared<const Mesh>(options.packages ? packageDistractor(random) : plainDistractor(random)),
                   -1, Eigen::Isometry3d::Identity()});
  }
  return things;
}

/// Where things come to lie; those that never stay on the table are taken out of the list.
void dropAll(std::vector<TableThing>& things, const SceneOptions& options, PixelRandom& random) {
  TablePhysics physics(table_half);
  std::map<const Mesh*, std::unique_ptr<RigidBody>> bodies;
  std::vector<TableThing> lying;
  for (const TableThing& thing : things) {
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
  const std::vector<Eigen::Isometry3d> poses = physics.settle();
  for (std::size_t i = 0; i < things.size(); ++i) things[i].T_table_thing = poses[i];
}

}  // namespace

TableStage::TableStage(const std::vector<SceneModel>& models, const SceneOptions& options, std::uint64_t number)
    : options_(options), number_(number), random_(options.seed, number, scene_stream) {
  validate(options);
  if (models.empty() && options.objects > 0) throw Error(ErrorCode::bad_usage, "there are no models for the scene");
  things_ = chooseThings(models, options, random_);
  dropAll(things_, options, random_);
  std::map<const Mesh*, std::size_t> meshes;
  for (const TableThing& thing : things_) {
    const auto [mesh, fresh] = meshes.try_emplace(thing.mesh.get(), 0);
    if (fresh) mesh->second = renderer_.addMesh(thing.mesh);
    renderer_.addInstance(mesh->second, thing.T_table_thing);
  }
  visible_.assign(renderer_.instanceCount(), 1);
}

void TableStage::addRoom(const Eigen::Isometry3d& T_table_camera) {
  if (options_.room == Room::plain) addPlainRoom(T_table_camera);
  if (options_.room == Room::furnished) {
    renderer_.addInstance(renderer_.addMesh(std::make_shared<const Mesh>(patternedTable(options_.seed, number_))),
                          Eigen::Isometry3d::Identity());
    furnish(renderer_, T_table_camera, options_.seed, number_);
  }
  visible_.resize(renderer_.instanceCount(), 1);
}

/// Table, and perhaps a wall on the side that is far from the camera.
void TableStage::addPlainRoom(const Eigen::Isometry3d& T_table_camera) {
  const auto add = [&](const Eigen::Vector3f& size, const Rgb& color, const Eigen::Isometry3d& pose) {
    renderer_.addInstance(renderer_.addMesh(std::make_shared<const Mesh>(makeBox(size, plain(color)))), pose);
  };
  add({float(2 * table_half), float(2 * table_half), float(table_thickness)}, anyColor(random_, 90, 220),
      Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.5 * table_thickness)));
  const Rgb color = anyColor(random_, 150, 240);
  if (random_.uniform() >= options_.wall_share) return;
  const double azimuth = std::atan2(T_table_camera.translation().y(), T_table_camera.translation().x());
  Eigen::Isometry3d pose(Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()));
  pose.translate(Eigen::Vector3d(-table_half, 0, 0.3));
  add({0.05f, 4, 2}, color, pose);
}

std::size_t TableStage::addProp(std::shared_ptr<const Mesh> mesh) {
  const std::size_t instance = renderer_.addInstance(renderer_.addMesh(std::move(mesh)), Eigen::Isometry3d::Identity());
  visible_.push_back(1);
  hideInstance(instance);
  return instance;
}

void TableStage::moveInstance(std::size_t instance, const Eigen::Isometry3d& T_table_mesh) {
  renderer_.moveInstance(instance, T_table_mesh);
  renderer_.setVisible(instance, true);
  visible_[instance] = 1;
  if (instance < things_.size()) things_[instance].T_table_thing = T_table_mesh;
}

void TableStage::hideInstance(std::size_t instance) {
  renderer_.setVisible(instance, false);
  visible_[instance] = 0;
}

/// How many pixels each thing has in the picture. @param measured only those with a depth
std::vector<std::size_t> TableStage::pixelCounts(const Rendering& view, bool measured) const {
  std::vector<std::size_t> counts(things_.size(), 0);
  for (std::size_t pixel = 0; pixel < view.instance.size(); ++pixel) {
    const std::int32_t i = view.instance[pixel];
    if (i < 0 || std::size_t(i) >= things_.size() || (measured && !view.cloud.points[pixel].allFinite())) continue;
    ++counts[std::size_t(i)];
  }
  return counts;
}

/// What fraction of each thing is not occluded by others.
std::vector<double> TableStage::visibilities(const Eigen::Isometry3d& T_table_camera, const Rendering& view) {
  CameraModel camera = options_.camera;
  camera.noise = CameraNoise::none();
  camera.color = {};
  const std::vector<std::size_t> seen = pixelCounts(view);
  std::vector<double> result(things_.size(), 0);
  for (std::size_t i = 0; i < visible_.size(); ++i) renderer_.setVisible(i, false);
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (things_[i].model < 0 || seen[i] == 0) continue;
    renderer_.setVisible(i, true);
    const Rendering alone = renderer_.render(camera, T_table_camera, 0, options_.threads);
    result[i] = double(seen[i]) / double(pixelCounts(alone)[i]);
    renderer_.setVisible(i, false);
  }
  for (std::size_t i = 0; i < visible_.size(); ++i) renderer_.setVisible(i, visible_[i] != 0);
  return result;
}

SimulatedScene TableStage::look(const Eigen::Isometry3d& T_table_camera, std::uint64_t picture) {
  SimulatedScene scene;
  scene.T_table_camera = T_table_camera;
  CameraModel camera = options_.camera;
  camera.noise.seed = options_.seed;
  scene.view = renderer_.render(camera, T_table_camera, picture, number_, options_.threads);
  const std::vector<double> visible = visibilities(T_table_camera, scene.view);
  const std::vector<std::size_t> points = pixelCounts(scene.view, true);
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (things_[i].model < 0) continue;
    scene.objects.push_back(
        {std::size_t(things_[i].model), T_table_camera.inverse() * things_[i].T_table_thing, visible[i], points[i]});
  }
  return scene;
}

}  // namespace sks
