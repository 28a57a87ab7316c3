// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulation/simulated_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include <opencv2/imgcodecs.hpp>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/file.hpp>
#include <sks_detector/simulation/mesh_symmetry.hpp>

namespace sks::tools {
namespace {

namespace fs = std::filesystem;

constexpr double least_visibility = 0.05;  // objects of which less is seen are not asked for

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

template <typename Values>
std::string list(const Values& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "[" : ", ") + number(v);
  return text + "]";
}

std::string yamlText(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return result + "\"";
}

/// A mesh's file as seen from the data set file.
std::string relativeSource(const std::string& source, const std::string& folder) {
  return source.rfind("builtin:", 0) == 0 ? source : fs::relative(source, folder).lexically_normal().string();
}

void writePng(const std::string& path, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", image, bytes)) throw Error(ErrorCode::bad_file, "cannot write '" + path + "': no PNG");
  writeFileAtomically(path, std::string(bytes.begin(), bytes.end()));
}

cv::Mat3b colorImage(const Cloud& cloud) {
  cv::Mat3b image(int(cloud.height), int(cloud.width));
  std::transform(cloud.colors.begin(), cloud.colors.end(), image.begin(),
                 [](const Rgb& c) { return cv::Vec3b(c.b, c.g, c.r); });
  return image;
}

cv::Mat1w depthImage(const Rendering& view) {
  cv::Mat1w image(int(view.cloud.height), int(view.cloud.width));
  const std::vector<float> depth = view.depth();
  std::transform(depth.begin(), depth.end(), image.begin(), [](float z) {
    return std::isfinite(z) ? std::uint16_t(std::min(65535L, std::lround(1000 * z))) : std::uint16_t(0);
  });
  return image;
}

std::string symmetryText(const TrainingEntry& entry, const Mesh& mesh) {
  const std::optional<Symmetry> symmetry = entry.symmetry ? entry.symmetry : estimateSymmetry(mesh);
  if (!symmetry) return "";
  return ", symmetry: {axis: " + list(std::vector<double>(symmetry->axis.data(), symmetry->axis.data() + 3)) +
         ", order: " + (symmetry->order == 0 ? "inf" : std::to_string(symmetry->order)) + "}";
}

}  // namespace

SimulatedSet::SimulatedSet(const std::string& folder, const std::vector<TrainingEntry>& training,
                           const std::vector<SceneModel>& models)
    : folder_(folder) {
  std::error_code error;
  fs::create_directories(fs::path(folder) / "scenes", error);
  if (error) throw Error(ErrorCode::bad_file, "cannot make the folder '" + folder + "': " + error.message());
  for (std::size_t i = 0; i < models.size(); ++i) {
    sources_.push_back(relativeSource(models[i].source, folder));
    objects_.push_back(models[i].object);
    centers_.push_back(models[i].mesh->box().center().cast<double>());
    training_ += "  - {object: " + yamlText(objects_[i]) + ", cloud: " + yamlText(sources_[i]) + ", kind: mesh" +
                 symmetryText(training[i], *models[i].mesh) + "}\n";
  }
}

void SimulatedSet::add(const SimulatedScene& scene) {
  char name[32];
  std::snprintf(name, sizeof(name), "scene%03d", count_++);
  const std::string base = (fs::path(folder_) / "scenes" / name).string();
  writeCloud(base + ".pcd", scene.view.cloud);
  writePng(base + "_color.png", colorImage(scene.view.cloud));
  writePng(base + "_depth.png", depthImage(scene.view));

  std::string objects;
  std::set<std::string> hidden;
  for (const ScenePlacement& placed : scene.objects) {
    if (placed.visibility < least_visibility) {
      hidden.insert(objects_[placed.model]);
      continue;
    }
    const Eigen::Vector3d position = placed.T_camera_model * centers_[placed.model];
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose = placed.T_camera_model.matrix();
    objects += "      - object: " + yamlText(objects_[placed.model]) +
               "\n        position: " + list(std::vector<double>(position.data(), position.data() + 3)) +
               "\n        reference: " + yamlText(sources_[placed.model]) +
               "\n        pose: " + list(std::vector<double>(pose.data(), pose.data() + 16)) +
               "\n        visibility: " + number(placed.visibility) + "\n";
  }
  scenes_ += std::string("  - name: ") + name + "\n    cloud: scenes/" + name + ".pcd\n";
  if (!objects.empty()) scenes_ += "    objects:\n" + objects;
  if (hidden.empty()) return;
  scenes_ += "    ignore: [";
  for (const std::string& object : hidden) scenes_ += (object == *hidden.begin() ? "" : ", ") + yamlText(object);
  scenes_ += "]\n";
}

std::string SimulatedSet::finish() const {
  const std::string path = (fs::path(folder_) / "dataset.yaml").string();
  writeFileAtomically(
      path,
      "# Simulated scenes: exact poses; visibility is the share of an object's pixels that others do not hide.\n"
      "name: simulated\nunits: m\nmax_distance: 0.05\ntraining:\n" +
          training_ + "scenes:\n" + scenes_);
  return path;
}

}  // namespace sks::tools
