// SPDX-License-Identifier: BSD-3-Clause
// BOP challenge: models/obj_<id>.ply in millimetres, <split>/<scene>/{scene_camera,scene_gt}.json, depth/ and rgb/.
// What of that a download lacks is counted. Objects are called obj_<id> and scenes <scene>/<image>, which `sks evaluate
// --bop-results` turns into numbers again.
#include <algorithm>
#include <set>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "core/settings/shown_text.hpp"
#include "tools/import/bop_files.hpp"
#include "tools/import/importer.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

constexpr double least_part_seen = 0.1;  // objects of which less is seen are not asked for, as in the challenge

/// The folder of scenes.
fs::path splitFolder(const ImportOptions& options) {
  std::vector<std::string> found;
  for (const char* kind : {"test", "val", "train"}) {
    for (const fs::path& folder : foldersIn(options.folder)) {
      const std::string name = folder.filename().string();
      if (options.split.empty() ? name.compare(0, std::string(kind).size(), kind) == 0 : name == options.split) {
        return folder;
      }
      if (name.compare(0, std::string(kind).size(), kind) == 0) found.push_back(name);
    }
  }
  throw Error(ErrorCode::bad_file, "'" + options.folder + "' has no folder " +
                                       (options.split.empty() ? "test" : options.split) + " with scenes" +
                                       (found.empty() ? "" : "; there is " + shownList(found)));
}

/// The folder of meshes.
fs::path modelFolder(const ImportOptions& options) {
  fs::path folder = fs::path(options.folder) / options.models;
  if (fs::is_directory(folder)) return folder;
  std::vector<std::string> others;
  for (const fs::path& other : foldersIn(options.folder)) {
    if (other.filename().string().rfind("models", 0) == 0) others.push_back(other.filename().string());
  }
  const std::string lacking = "'" + options.folder + "' has no folder '" + options.models + "'";
  if (!others.empty()) {
    throw Error(ErrorCode::bad_usage, lacking + "; there is " + shownList(others) + ": choose by --models NAME");
  }
  throw Error(ErrorCode::bad_file, "'" + options.folder + "' is no BOP data set: it has no folder '" + options.models +
                                       "'; unpack <name>_models.zip");
}

class BopImporter {
public:
  explicit BopImporter(const ImportContext& context) : context_(context), models_(modelFolder(context.options())) {}

  ImportedSet run() {
    set_.units = "mm";
    addModels();
    const fs::path split = splitFolder(context_.options());
    for (const fs::path& folder : foldersIn(split)) addScene(folder);
    if (set_.data_set.scenes.empty()) {
      throw Error(ErrorCode::bad_data,
                  "'" + split.string() + "' has no scenes with images" +
                      (incomplete_ > 0 ? ": none of the " + std::to_string(listed_) +
                                             " that its scene_camera.json list is there; unpack them"
                                       : ""));
    }
    addWarnings();
    return std::move(set_);
  }

private:
  void addModels() {
    const std::map<int, BopModelInfo> infos = readBopModelInfo(models_);
    for (const fs::path& path : filesIn(models_, ".ply")) {
      TrainingEntry entry = trainingEntry(path.stem().string(), path, ViewKind::model);
      entry.mesh = true;
      for (const auto& [object, info] : infos) {
        if (entry.object != nameOf(object)) continue;
        entry.symmetry = info.symmetry;
        entry.symmetries = info.symmetries;
        entry.diameter = info.diameter;
      }
      Eigen::AlignedBox3f box;
      for (const Eigen::Vector3f& point : readCloud(entry.path).points) box.extend(point);
      centers_[entry.object] = box.center().cast<double>();
      set_.data_set.training.push_back(std::move(entry));
    }
  }

  static std::string nameOf(int object) { return "obj_" + bopNumber(object); }

  void addScene(const fs::path& folder) {
    if (!fs::exists(folder / "scene_camera.json")) {
      folders_without_cameras_.push_back(folder.filename().string());
      return;
    }
    const BopScene read = readBopScene(folder);
    set_.warnings.insert(set_.warnings.end(), read.warnings.begin(), read.warnings.end());
    const std::vector<BopImage>& images = read.images;
    const std::size_t step = std::size_t(std::max(1, context_.options().every));
    for (std::size_t i = 0; i < images.size(); i += step) {
      const std::string name = folder.filename().string() + "/" + bopNumber(images[i].id);
      report(context_.progress(), {"converting scene " + folder.filename().string(), name, i, images.size()});
      ++listed_;
      const BopPictures pictures = findBopPictures(folder, images[i].id);
      if (!pictures.complete) {
        ++incomplete_;
        continue;
      }
      if (pictures.color.empty()) ++uncolored_;
      Scene scene;
      scene.name = name;
      scene.path = context_.writeCloud(name, readBopCloud(pictures, images[i].camera));
      if (images[i].has_truth) {
        addTruth(images[i], folder, scene);
      } else {
        ++without_truth_;
        for (const auto& model : centers_) scene.ignore.push_back(model.first);
      }
      set_.data_set.scenes.push_back(std::move(scene));
    }
  }

  void addWarnings() {
    const auto warn = [&](std::size_t count, const std::string& what) {
      if (count == 0) return;
      set_.warnings.push_back(std::to_string(count) + " of " + std::to_string(listed_) + " images " + what);
    };
    warn(incomplete_, "were left out: their depth or rgb picture is not there; unpack the rest of the download");
    warn(uncolored_, "have no colour, since there is no folder rgb: train shape alone (--set descriptor.type=shot)");
    warn(without_truth_,
         "are without truth (scene_gt.json): detections of all objects are ignored in them, so that they serve "
         "--bop-results, but no score");
    if (folders_without_cameras_.empty()) return;
    set_.warnings.push_back("left out, since they have no scene_camera.json: " + shownList(folders_without_cameras_));
  }

  void addTruth(const BopImage& image, const fs::path& folder, Scene& scene) const {
    std::set<std::string> hidden, seen;
    for (const BopInstance& instance : image.instances) {
      GroundTruth truth;
      truth.object = nameOf(instance.object);
      const auto center = centers_.find(truth.object);
      if (center == centers_.end()) {
        throw Error(ErrorCode::bad_data, (folder / "scene_gt.json").string() + ": image " + std::to_string(image.id) +
                                             " has object " + std::to_string(instance.object) + ", but there is no " +
                                             models_.filename().string() + "/" + truth.object + ".ply");
      }
      truth.reference = (models_ / (truth.object + ".ply")).string();
      truth.T_scene_reference = instance.T_camera_model;
      truth.position = instance.T_camera_model * center->second;
      if (instance.visibility) truth.visibility = std::clamp(*instance.visibility, 0.0, 1.0);
      const bool visible = instance.visibility.value_or(1) >= least_part_seen;
      (visible ? seen : hidden).insert(truth.object);
      if (visible) scene.objects.push_back(std::move(truth));
    }
    for (const std::string& object : hidden) {
      if (seen.count(object) == 0) scene.ignore.push_back(object);
    }
  }

  const ImportContext& context_;
  fs::path models_;
  ImportedSet set_;
  std::size_t listed_ = 0, incomplete_ = 0, uncolored_ = 0, without_truth_ = 0;  // images
  std::vector<std::string> folders_without_cameras_;
  std::map<std::string, Eigen::Vector3d> centers_;  ///< of the models' boxes [mm]
};

}  // namespace

ImportedSet importBop(const ImportContext& context) {
  return BopImporter(context).run();
}

}  // namespace sks::tools
