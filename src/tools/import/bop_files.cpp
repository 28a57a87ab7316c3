// SPDX-License-Identifier: BSD-3-Clause
#include "tools/import/bop_files.hpp"

#include <algorithm>
#include <cstdio>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "io/nearest_rotation.hpp"
#include "tools/import/bop_json.hpp"

namespace sks::tools {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

BopCamera cameraOf(const BopNode& node) {
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
  BopInstance instanceOf(const BopNode& node) {
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
  const json cameras = readBopJson(camera_file);
  json truth = json::object(), info = json::object();
  if (fs::exists(truth_file)) truth = readBopJson(truth_file);
  if (fs::exists(info_file)) info = readBopJson(info_file);
  PoseReader poses;
  BopScene scene;
  for (const auto& [key, value] : cameras.items()) {
    const BopNode camera{value, camera_file.string() + ": image " + key};
    BopImage image{bopId(key, camera_file), cameraOf(camera), truth.contains(key), {}};
    for (std::size_t i = 0; image.has_truth && i < truth[key].size(); ++i) {
      const std::string where = ": image " + key + ", object " + std::to_string(i);
      BopInstance instance = poses.instanceOf({truth[key][i], truth_file.string() + where});
      if (info.contains(key) && i < info[key].size()) {
        instance.visibility = BopNode{info[key][i], info_file.string() + where}.at("visib_fract").number();
      }
      image.instances.push_back(instance);
    }
    scene.images.push_back(std::move(image));
  }
  std::sort(scene.images.begin(), scene.images.end(), [](const BopImage& a, const BopImage& b) { return a.id < b.id; });
  poses.warn(scene.warnings);
  return scene;
}

std::string bopNumber(int number) {
  char text[16];
  std::snprintf(text, sizeof(text), "%06d", number);
  return text;
}

}  // namespace sks::tools
