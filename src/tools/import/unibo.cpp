// SPDX-License-Identifier: BSD-3-Clause
// UniBo 3-D recognition sets (Tombari, Salti, Di Stefano): an .ini file for each scene names its cloud, its models and
// for each model an .xf file with the pose, 16 numbers.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "io/file.hpp"
#include "io/nearest_rotation.hpp"
#include "io/number_text.hpp"
#include "tools/import/importer.hpp"
#include "tools/import/unibo_ini.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

/// Views of one object lie in a folder that is called like them: mario/mario012.ply.
bool isView(const fs::path& model) {
  const std::string folder = model.parent_path().filename().string(), stem = model.stem().string();
  return !folder.empty() && stem.compare(0, folder.size(), folder) == 0 && stem.size() > folder.size() &&
         stem.find_first_not_of("0123456789_-", folder.size()) == std::string::npos;
}

std::string objectOf(const fs::path& model) {
  return isView(model) ? model.parent_path().filename().string() : model.stem().string();
}

Eigen::Isometry3d readPose(const std::string& path, std::vector<std::string>& warnings) {
  std::istringstream text = plainStream(readTextFile(path));
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) {
    if (!(text >> matrix(i / 4, i % 4))) {
      throw Error(ErrorCode::bad_file, path + ": a pose needs 16 numbers, row-major; there are " + std::to_string(i));
    }
  }
  const NearestRotation nearest = nearestRotation(matrix.topLeftCorner<3, 3>());
  if (!nearest.fault.empty()) {
    throw Error(ErrorCode::bad_data,
                path + ": its upper left 3 x 3 numbers are no rotation: the matrix " + nearest.fault);
  }
  if (nearest.deviation > skew_rotation) {
    warnings.push_back(
        path + formatted(": its rotation is orthonormal to %.2g only; the nearest one is written", nearest.deviation));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = nearest.rotation;
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

class UniboImporter {
public:
  explicit UniboImporter(const ImportContext& context) : context_(context) {}

  ImportedSet run() {
    const std::string& folder = context_.options().folder;
    const std::vector<fs::path> files = filesBelow(folder, ".ini");
    for (std::size_t i = 0; i < files.size(); ++i) {
      report(context_.progress(), {"reading", files[i].filename().string(), i, files.size()});
      if (const auto scene = readUniboIni(files[i].string(), folder)) addScene(*scene);
    }
    report(context_.progress(), {"reading", "", files.size(), files.size()});
    if (set_.data_set.scenes.empty()) {
      throw Error(ErrorCode::bad_data, "'" + folder +
                                           "' is no UniBo data set: no .ini file in it names a scene and "
                                           "the ground truth of its models");
    }
    addTraining();
    return std::move(set_);
  }

private:
  void addScene(const UniboScene& ini) {
    Scene scene;
    scene.name = fs::path(ini.cloud).stem().string();
    if (!names_.insert(scene.name).second) {  // several noise levels may share names
      scene.name = fs::path(ini.cloud).parent_path().filename().string() + "/" + scene.name;
    }
    scene.path = ini.cloud;
    for (const UniboModel& model : ini.models) {
      GroundTruth truth;
      truth.object = objectOf(model.cloud);
      truth.reference = model.cloud;
      truth.T_scene_reference = readPose(model.pose, set_.warnings);
      truth.position = *truth.T_scene_reference * boxCenter(model.cloud);
      scene.objects.push_back(std::move(truth));
    }
    set_.data_set.scenes.push_back(std::move(scene));
  }

  /// Of a model's cloud; also notes that it is to be trained.
  Eigen::Vector3d boxCenter(const std::string& path) {
    const auto known = centers_.find(path);
    if (known != centers_.end()) return known->second;
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& point : readCloud(path).points) {
      if (point.allFinite()) box.extend(point);
    }
    if (box.isEmpty()) throw Error(ErrorCode::bad_data, path + ": the model has no points");
    return centers_[path] = box.center().cast<double>();
  }

  /// The models of the ground truth and, of views, all others beside them.
  void addTraining() {
    std::set<std::string> models;
    for (const auto& known : centers_) {
      const fs::path path(known.first);
      models.insert(known.first);
      if (!isView(path)) continue;
      for (const fs::path& other : filesIn(path.parent_path(), path.extension().string())) {
        if (isView(other)) models.insert(other.lexically_normal().string());
      }
    }
    for (const std::string& model : models) {
      const ViewKind kind = isView(model) ? ViewKind::view : ViewKind::model;
      set_.data_set.training.push_back(trainingEntry(objectOf(model), model, kind));
    }
  }

  const ImportContext& context_;
  ImportedSet set_;
  std::set<std::string> names_;
  std::map<std::string, Eigen::Vector3d> centers_;
};

}  // namespace

ImportedSet importUnibo(const ImportContext& context) {
  return UniboImporter(context).run();
}

}  // namespace sks::tools
