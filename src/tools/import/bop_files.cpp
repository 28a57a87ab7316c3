// SPDX-License-Identifier: BSD-3-Clause
#include "tools/import/bop_files.hpp"

#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "io/file.hpp"
#include "io/nearest_rotation.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json readJson(const fs::path& path) {
  try {
    return json::parse(readTextFile(path.string(), std::size_t(1) << 30));
  } catch (const json::exception& error) {
    throw Error(ErrorCode::bad_file, path.string() + ": not a JSON file: " + error.what());
  }
}

/// A value that may be wrong: `where` tells file and image.
struct Node {
  const json& value;
  std::string where;

  Node at(const std::string& key) const {
    if (!value.is_object() || !value.contains(key)) {
      throw Error(ErrorCode::bad_file, where + ": the key '" + key + "' is missing");
    }
    return {value[key], where + ", " + key};
  }
  double number() const {
    if (!value.is_number()) throw Error(ErrorCode::bad_file, where + ": must be a number");
    return value.get<double>();
  }
  std::vector<double> numbers(std::size_t count) const {
    const bool fits = value.is_array() && value.size() == count &&
                      std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
    if (!fits) throw Error(ErrorCode::bad_file, where + ": must be a list of " + std::to_string(count) + " numbers");
    return value.get<std::vector<double>>();
  }
};

int idOf(const std::string& key, const fs::path& file) {
  if (key.empty() || key.size() > 9 || key.find_first_not_of("0123456789") != std::string::npos) {
    throw Error(ErrorCode::bad_file, file.string() + ": '" + key + "' is no number of an image");
  }
  return std::stoi(key);
}

BopCamera cameraOf(const Node& node) {
  const std::vector<double> k = node.at("cam_K").numbers(9);
  BopCamera camera{k[0], k[4], k[2], k[5], node.at("depth_scale").number()};
  if (camera.fx <= 0 || camera.fy <= 0 || camera.depth_scale <= 0) {
    throw Error(ErrorCode::bad_file, node.where + ": focal lengths and depth_scale must be greater than 0");
  }
  return camera;
}

/// Reads poses, and counts those that were only nearly rigid.
class PoseReader {
public:
  BopInstance instanceOf(const Node& node) {
    BopInstance instance;
    instance.object = int(node.at("obj_id").number());
    const std::vector<double> R = node.at("cam_R_m2c").numbers(9), t = node.at("cam_t_m2c").numbers(3);
    const NearestRotation nearest =
        nearestRotation(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data()));
    if (!nearest.fault.empty()) throw Error(ErrorCode::bad_data, node.where + ", cam_R_m2c: " + nearest.fault);
    if (nearest.deviation > skew_rotation) {
      if (skew_++ == 0) first_ = node.where;
      largest_ = std::max(largest_, nearest.deviation);
    }
    instance.T_camera_model = Eigen::Isometry3d::Identity();
    instance.T_camera_model.linear() = nearest.rotation;
    instance.T_camera_model.translation() = Eigen::Map<const Eigen::Vector3d>(t.data());
    return instance;
  }

  void warn(std::vector<std::string>& warnings) const {
    if (skew_ == 0) return;
    warnings.push_back(first_ + (skew_ > 1 ? " and " + std::to_string(skew_ - 1) + " more" : "") +
                       formatted(": cam_R_m2c is orthonormal to %.2g only; the nearest rotation is written", largest_));
  }

private:
  std::string first_;  // where it stands
  std::size_t skew_ = 0;
  double largest_ = 0;
};

}  // namespace

BopScene readBopScene(const fs::path& folder) {
  const fs::path camera_file = folder / "scene_camera.json", truth_file = folder / "scene_gt.json",
                 info_file = folder / "scene_gt_info.json";
  const json cameras = readJson(camera_file);
  json truth = json::object(), info = json::object();
  if (fs::exists(truth_file)) truth = readJson(truth_file);
  if (fs::exists(info_file)) info = readJson(info_file);
  PoseReader poses;
  BopScene scene;
  for (const auto& [key, value] : cameras.items()) {
    const Node camera{value, camera_file.string() + ": image " + key};
    BopImage image{idOf(key, camera_file), cameraOf(camera), truth.contains(key), {}};
    for (std::size_t i = 0; image.has_truth && i < truth[key].size(); ++i) {
      const std::string where = ": image " + key + ", object " + std::to_string(i);
      BopInstance instance = poses.instanceOf({truth[key][i], truth_file.string() + where});
      if (info.contains(key) && i < info[key].size()) {
        instance.visibility = Node{info[key][i], info_file.string() + where}.at("visib_fract").number();
      }
      image.instances.push_back(instance);
    }
    scene.images.push_back(std::move(image));
  }
  std::sort(scene.images.begin(), scene.images.end(), [](const BopImage& a, const BopImage& b) { return a.id < b.id; });
  poses.warn(scene.warnings);
  return scene;
}

std::map<int, Symmetry> readBopSymmetries(const fs::path& models) {
  std::map<int, Symmetry> symmetries;
  const fs::path file = models / "models_info.json";
  if (!fs::exists(file)) return symmetries;
  const json info = readJson(file);
  for (const auto& [key, value] : info.items()) {
    const Node model{value, file.string() + ": object " + key};
    if (value.contains("symmetries_continuous") && !value["symmetries_continuous"].empty()) {
      const Node first{value["symmetries_continuous"][0], model.where};
      const std::vector<double> axis = first.at("axis").numbers(3);
      symmetries[idOf(key, file)] = {Eigen::Vector3d(axis[0], axis[1], axis[2]).normalized(), 0};
      continue;
    }
    if (!value.contains("symmetries_discrete") || value["symmetries_discrete"].empty()) continue;
    const json& turns = value["symmetries_discrete"];
    std::vector<Eigen::Vector3d> axes;
    for (const json& turn : turns) {
      const std::vector<double> m = Node{turn, model.where + ", symmetries_discrete"}.numbers(16);
      Eigen::Matrix3d R;
      R << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
      axes.push_back(Eigen::AngleAxisd(R).axis());
    }
    const auto parallel = [&](const Eigen::Vector3d& axis) { return std::abs(axis.dot(axes[0])) > 0.999; };
    if (std::all_of(axes.begin(), axes.end(), parallel)) symmetries[idOf(key, file)] = {axes[0], int(turns.size()) + 1};
  }
  return symmetries;
}

std::string bopNumber(int number) {
  char text[16];
  std::snprintf(text, sizeof(text), "%06d", number);
  return text;
}

}  // namespace sks::tools
