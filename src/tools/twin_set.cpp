// SPDX-License-Identifier: BSD-3-Clause
#include "tools/twin_set.hpp"

#include <filesystem>
#include <map>
#include <memory>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "io/dataset.hpp"
#include "io/file.hpp"
#include "simulation/builtin_objects.hpp"
#include "simulation/twin.hpp"
#include "tools/command.hpp"
#include "tools/data_set_yaml.hpp"
#include "tools/scene_files.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

/// A mesh of the data set, and what it is called from the new one.
struct TwinMesh {
  std::shared_ptr<const Mesh> mesh;
  std::string source;
};

std::vector<TwinObject> objectsOf(const Scene& scene, const std::map<std::string, TwinMesh>& meshes) {
  std::vector<TwinObject> objects;
  for (const GroundTruth& truth : scene.objects) {
    const auto mesh = meshes.find(truth.reference);
    if (mesh == meshes.end() || !truth.T_scene_reference) {
      throw Error(ErrorCode::bad_data, "scene '" + scene.name + "': '" + truth.object +
                                           "' has no pose of a mesh that is listed under 'training': twins need one");
    }
    objects.push_back({mesh->second.mesh, *truth.T_scene_reference});
  }
  return objects;
}

}  // namespace

std::string writeTwins(const std::string& data_set, const std::string& folder, const CameraModel& camera, int threads,
                       const Progress& progress) {
  const DataSet original = loadDataSet(data_set);
  for (const std::string& warning : original.warnings) warn(warning);
  makeFolder((fs::path(folder) / "scenes").string());
  std::string text = "# Twins: recorded scenes whose objects were replaced by their meshes.\nname: " +
                     yamlText(original.name + "_twins") +
                     "\nunits: m\nmax_distance: " + std::to_string(original.max_distance) + "\ntraining:\n";
  std::map<std::string, TwinMesh> meshes;
  for (const TrainingEntry& entry : original.training) {
    if (!entry.mesh) continue;
    const double scale = entry.scale.value_or(original.scale);
    LoadedMesh loaded = findMesh(entry.path, scale);
    const std::string source = relativeSource(entry.path, folder);
    meshes[entry.source] = {std::make_shared<const Mesh>(std::move(loaded.mesh)), source};
    text += trainingYaml(entry.object, source, scale, entry.symmetry);
  }
  text += "scenes:\n";
  for (std::size_t i = 0; i < original.scenes.size(); ++i) {
    Scene scene = original.scenes[i];
    report(progress, {"simulating", scene.name, i, original.scenes.size()});
    const Twin twin = makeTwin(readCloud(scene.path, original.scale), objectsOf(scene, meshes), camera, i, threads);
    scene.path = "scenes/" + scene.name + ".pcd";
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      GroundTruth& truth = scene.objects[k];
      const TwinMesh& used = meshes.at(truth.reference);
      truth.points = twin.points[k];
      truth.reference = used.source;
    }
    writeSceneFiles((fs::path(folder) / "scenes" / scene.name).string(), twin.cloud);
    text += sceneYaml(scene);
  }
  std::string path = (fs::path(folder) / "dataset.yaml").string();
  writeFileAtomically(path, text);
  return path;
}

}  // namespace sks::tools
