// SPDX-License-Identifier: BSD-3-Clause
// BOP challenge: models/obj_<id>.ply in millimetres, <split>/<scene>/{scene_camera,scene_gt}.json, depth/ and rgb/.
// Objects are called obj_<id> and scenes <scene>/<image>, which `sks evaluate --bop-results` turns into numbers again.
#include <algorithm>
#include <set>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "tools/import/bop_files.hpp"
#include "tools/import/importer.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

constexpr double least_visibility = 0.1;  // objects of which less is seen are not asked for, as in the challenge

/// The folder of scenes.
fs::path splitFolder(const ImportOptions& options) {
  std::string found;
  for (const char* kind : {"test", "val", "train"}) {
    for (const fs::path& folder : foldersIn(options.folder)) {
      const std::string name = folder.filename().string();
      if (options.split.empty() ? name.compare(0, std::string(kind).size(), kind) == 0 : name == options.split) {
        return folder;
      }
      if (name.compare(0, std::string(kind).size(), kind) == 0) found += " " + name;
    }
  }
  throw Error(ErrorCode::bad_file, "'" + options.folder + "' has no folder " +
                                       (options.split.empty() ? "test" : options.split) + " with scenes" +
                                       (found.empty() ? "" : "; there is" + found));
}

class BopImporter {
public:
  explicit BopImporter(const ImportContext& context) : context_(context) {}

  ImportedSet run() {
    set_.units = "mm";
    addModels();
    const fs::path split = splitFolder(context_.options());
    const std::vector<fs::path> scenes = foldersIn(split);
    for (const fs::path& folder : scenes) addScene(folder);
    if (set_.data_set.scenes.empty()) {
      throw Error(ErrorCode::bad_data, "'" + split.string() + "' has no scenes with images");
    }
    return std::move(set_);
  }

private:
  void addModels() {
    const fs::path folder = fs::path(context_.options().folder) / "models";
    if (!fs::is_directory(folder)) {
      throw Error(ErrorCode::bad_file, "'" + context_.options().folder +
                                           "' is no BOP data set: it has no folder 'models'; unpack <name>_models.zip");
    }
    const std::map<int, Symmetry> symmetries = readBopSymmetries(folder);
    for (const fs::path& path : filesIn(folder, ".ply")) {
      TrainingEntry entry = trainingEntry(path.stem().string(), path, ViewKind::model);
      entry.mesh = true;
      for (const auto& [object, symmetry] : symmetries) {
        if (entry.object == nameOf(object)) entry.symmetry = symmetry;
      }
      Eigen::AlignedBox3f box;
      for (const Eigen::Vector3f& point : readCloud(entry.path).points) box.extend(point);
      centers_[entry.object] = box.center().cast<double>();
      set_.data_set.training.push_back(std::move(entry));
    }
  }

  static std::string nameOf(int object) { return "obj_" + bopNumber(object); }

  void addScene(const fs::path& folder) {
    const std::vector<BopImage> images = readBopScene(folder);
    const std::size_t step = std::size_t(std::max(1, context_.options().every));
    for (std::size_t i = 0; i < images.size(); i += step) {
      const std::string name = folder.filename().string() + "/" + bopNumber(images[i].id);
      report(context_.progress(), {"converting scene " + folder.filename().string(), name, i, images.size()});
      Scene scene;
      scene.name = name;
      scene.path = context_.writeCloud(name, readBopCloud(folder, images[i]));
      addTruth(images[i], folder, scene);
      set_.data_set.scenes.push_back(std::move(scene));
    }
  }

  void addTruth(const BopImage& image, const fs::path& folder, Scene& scene) const {
    std::set<std::string> hidden, seen;
    for (const BopInstance& instance : image.instances) {
      GroundTruth truth;
      truth.object = nameOf(instance.object);
      const auto center = centers_.find(truth.object);
      if (center == centers_.end()) {
        throw Error(ErrorCode::bad_data, (folder / "scene_gt.json").string() + ": image " + std::to_string(image.id) +
                                             " has object " + std::to_string(instance.object) +
                                             ", but there is no models/" + truth.object + ".ply");
      }
      truth.reference = (fs::path(context_.options().folder) / "models" / (truth.object + ".ply")).string();
      truth.T_scene_reference = instance.T_camera_model;
      truth.position = instance.T_camera_model * center->second;
      if (instance.visibility) truth.visibility = std::clamp(*instance.visibility, 0.0, 1.0);
      const bool visible = instance.visibility.value_or(1) >= least_visibility;
      (visible ? seen : hidden).insert(truth.object);
      if (visible) scene.objects.push_back(std::move(truth));
    }
    for (const std::string& object : hidden) {
      if (seen.count(object) == 0) scene.ignore.push_back(object);
    }
  }

  const ImportContext& context_;
  ImportedSet set_;
  std::map<std::string, Eigen::Vector3d> centers_;  ///< of the models' boxes [mm]
};

}  // namespace

ImportedSet importBop(const ImportContext& context) {
  return BopImporter(context).run();
}

}  // namespace sks::tools
