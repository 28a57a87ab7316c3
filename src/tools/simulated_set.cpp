// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulated_set.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "io/file.hpp"
#include "simulation/mesh_symmetry.hpp"
#include "tools/cluster/cluster.hpp"
#include "tools/data_set_yaml.hpp"
#include "tools/scene_files.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

constexpr double hidden = 0.001;  // share of what cannot be seen at all: 0 would say that it is unknown

}  // namespace

SimulatedSet::SimulatedSet(const std::string& folder, const std::vector<TrainingEntry>& training,
                           const std::vector<SceneModel>& models, std::size_t least_points)
    : folder_(folder), least_points_(least_points) {
  if (leads()) makeFolder((fs::path(folder) / "scenes").string());
  for (std::size_t i = 0; i < models.size(); ++i) {
    sources_.push_back(relativeSource(models[i].source, folder));
    objects_.push_back(models[i].object);
    boxes_.push_back(models[i].mesh->box().cast<double>());
    training_ += trainingYaml(objects_[i], sources_[i], training[i].scale.value_or(0),
                              training[i].symmetry ? training[i].symmetry : estimateSymmetry(*models[i].mesh));
  }
}

std::vector<Detection> SimulatedSet::truth(const SimulatedScene& scene) const {
  std::vector<Detection> truth;
  for (const ScenePlacement& placed : scene.objects) {
    Detection object;
    object.object = objects_[placed.model];
    object.score = std::max(hidden, placed.visibility);
    object.view = sources_[placed.model];
    object.T_scene_model = placed.T_camera_model;
    object.T_scene_box = placed.T_camera_model * Eigen::Translation3d(boxes_[placed.model].center());
    object.box_size = boxes_[placed.model].sizes();
    truth.push_back(std::move(object));
  }
  return truth;
}

std::string SimulatedSet::write(const SimulatedScene& scene, std::size_t number) const {
  char name[32];
  std::snprintf(name, sizeof(name), "scene%03zu", number);
  const std::string base = (fs::path(folder_) / "scenes" / name).string();
  writeSceneFiles(base, scene.view.cloud);
  std::vector<std::size_t> points;
  for (const ScenePlacement& placed : scene.objects) points.push_back(placed.points);
  Scene entry = groundTruthScene(name, truth(scene), points, least_points_);
  entry.path = std::string("scenes/") + name + ".pcd";
  return sceneYaml(entry);
}

void SimulatedSet::list(const std::string& written) {
  scenes_ += written;
  ++count_;
}

void SimulatedSet::add(const SimulatedScene& scene, double stamp) {
  list(write(scene, count_));
  const Eigen::Vector3d p = scene.T_table_camera.translation();
  const Eigen::Quaterniond q(scene.T_table_camera.linear());
  char line[200];
  std::snprintf(line, sizeof(line), "%.6f %.6f %.6f %.6f %.8f %.8f %.8f %.8f\n", stamp, p.x(), p.y(), p.z(), q.x(),
                q.y(), q.z(), q.w());
  trajectory_ += line;
}

std::string SimulatedSet::finish(const ForceOption& force) const {
  if (!trajectory_.empty()) {
    force.write(
        (fs::path(folder_) / "camera.txt").string(),
        "# Pose of the camera's optical frame on the table for each scene, in their order (z of the table upwards):\n"
        "# stamp [s] x y z [m] qx qy qz qw\n" +
            trajectory_);
  }
  std::string path = (fs::path(folder_) / "dataset.yaml").string();
  force.write(
      path,
      "# Simulated scenes: exact poses; visibility is the share of an object's pixels that others do not hide,\n"
      "# points how many of the cloud lie on it.\n"
      "name: simulated\nunits: m\nmax_distance: 0.05\ntraining:\n" +
          training_ + "scenes:\n" + scenes_);
  return path;
}

}  // namespace sks::tools
