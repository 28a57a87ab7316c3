// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/scene.hpp"

#include <cmath>
#include <string>

#include <sks_detector/error.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "simulation/scene_random.hpp"
#include "simulation/table_stage.hpp"

namespace sks {
namespace {

Eigen::Isometry3d placeCamera(const SceneOptions& options, PixelRandom& random) {
  const double distance = between(random, options.min_distance, options.max_distance);
  const double elevation = between(random, options.min_elevation, options.max_elevation) * EIGEN_PI / 180;
  const double azimuth = 2 * EIGEN_PI * random.uniform();
  const Eigen::Vector3d target(between(random, -0.03, 0.03), between(random, -0.03, 0.03), 0.04);
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                  std::sin(elevation));
  return lookAt(target + distance * direction, target, Eigen::Vector3d::UnitZ());
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
  TableStage stage(models, options, number);
  const Eigen::Isometry3d T_table_camera = placeCamera(options, stage.random());
  stage.addRoom(T_table_camera);
  return stage.look(T_table_camera, number);
}

}  // namespace sks
