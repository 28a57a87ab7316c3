// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulated_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <sks_detector/cloud_io.hpp>

#include "core/settings/value_text.hpp"
#include "io/file.hpp"
#include "io/image_file.hpp"
#include "simulation/mesh_symmetry.hpp"
#include "tools/data_set_yaml.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

constexpr double hidden = 0.001;  // share of what cannot be seen at all: 0 would say that it is unknown

/// A mesh's file as seen from the data set file.
std::string relativeSource(const std::string& source, const std::string& folder) {
  return source.rfind("builtin:", 0) == 0 ? source : fs::relative(source, folder).lexically_normal().string();
}

ColorImage colorImage(const Cloud& cloud) {
  ColorImage image(int(cloud.width), int(cloud.height));
  image.pixels = cloud.colors;
  return image;
}

DepthImage depthImage(const Rendering& view) {
  DepthImage image(int(view.cloud.width), int(view.cloud.height));
  const std::vector<float> depth = view.depth();
  std::transform(depth.begin(), depth.end(), image.pixels.begin(), [](float z) {
    return std::isfinite(z) ? std::uint16_t(std::min(65535L, std::lround(1000 * z))) : std::uint16_t(0);
  });
  return image;
}

/// As it was given for the mesh.
std::string unitText(const TrainingEntry& entry) {
  return entry.scale.value_or(0) > 0 ? ", units: " + toText(*entry.scale) : "";
}

std::string symmetryText(const TrainingEntry& entry, const Mesh& mesh) {
  const std::optional<Symmetry> symmetry = entry.symmetry ? entry.symmetry : estimateSymmetry(mesh);
  if (!symmetry) return "";
  return ", symmetry: {axis: " + yamlList({symmetry->axis.x(), symmetry->axis.y(), symmetry->axis.z()}) +
         ", order: " + (symmetry->order == 0 ? "inf" : std::to_string(symmetry->order)) + "}";
}

}  // namespace

SimulatedSet::SimulatedSet(const std::string& folder, const std::vector<TrainingEntry>& training,
                           const std::vector<SceneModel>& models, std::size_t least_points)
    : folder_(folder), least_points_(least_points) {
  makeFolder((fs::path(folder) / "scenes").string());
  for (std::size_t i = 0; i < models.size(); ++i) {
    sources_.push_back(relativeSource(models[i].source, folder));
    objects_.push_back(models[i].object);
    boxes_.push_back(models[i].mesh->box().cast<double>());
    training_ += "  - {object: " + yamlText(objects_[i]) + ", cloud: " + yamlText(sources_[i]) + ", kind: mesh" +
                 unitText(training[i]) + symmetryText(training[i], *models[i].mesh) + "}\n";
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

void SimulatedSet::add(const SimulatedScene& scene) {
  char name[32];
  std::snprintf(name, sizeof(name), "scene%03d", count_++);
  const std::string base = (fs::path(folder_) / "scenes" / name).string();
  writeCloud(base + ".pcd", scene.view.cloud);
  writeFileAtomically(base + "_color.png", encodePng(colorImage(scene.view.cloud)));
  writeFileAtomically(base + "_depth.png", encodePng(depthImage(scene.view)));
  std::vector<std::size_t> points;
  for (const ScenePlacement& placed : scene.objects) points.push_back(placed.points);
  Scene entry = groundTruthScene(name, truth(scene), points, least_points_);
  entry.path = std::string("scenes/") + name + ".pcd";
  scenes_ += sceneYaml(entry);
}

std::string SimulatedSet::finish(const ForceOption& force) const {
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
