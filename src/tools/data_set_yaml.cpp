// SPDX-License-Identifier: BSD-3-Clause
#include "tools/data_set_yaml.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"
#include "core/settings/utf8.hpp"

namespace sks::tools {
namespace {

constexpr double least_visibility = 0.05;  // objects of which less is seen are not asked for

std::string number(double value) {
  return formatted("%.9g", value);
}

std::string groundTruthYaml(const GroundTruth& truth) {
  const Eigen::Vector3d& position = truth.position;
  std::string text = "      - object: " + yamlText(truth.object) +
                     "\n        position: " + yamlList({position.x(), position.y(), position.z()}) + "\n";
  if (!truth.reference.empty()) text += "        reference: " + yamlText(truth.reference) + "\n";
  if (truth.T_scene_reference) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose = truth.T_scene_reference->matrix();
    text += "        pose: " + yamlList(std::vector<double>(pose.data(), pose.data() + 16)) + "\n";
  }
  if (truth.visibility) text += "        visibility: " + number(*truth.visibility) + "\n";
  if (truth.points) text += "        points: " + std::to_string(*truth.points) + "\n";
  return text;
}

}  // namespace

std::string yamlText(const std::string& text) {
  if (!isUtf8(text)) {
    throw Error(ErrorCode::bad_data, "the name '" + shown(text) + "' is not UTF-8, as data set files are: rename it");
  }
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') result += '\\';
    result += code < 0x20 || code == 0x7f ? formatted("\\x%02x", unsigned(code)) : std::string(1, c);
  }
  return result + "\"";
}

std::string yamlList(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + number(value);
  return text + "]";
}

std::string sceneYaml(const Scene& scene) {
  std::string text = "  - name: " + yamlText(scene.name) + "\n    cloud: " + yamlText(scene.path) + "\n";
  if (!scene.objects.empty()) text += "    objects:\n";
  for (const GroundTruth& truth : scene.objects) text += groundTruthYaml(truth);
  if (scene.ignore.empty()) return text;
  text += "    ignore: [";
  for (const std::string& object : scene.ignore) text += (object == scene.ignore[0] ? "" : ", ") + yamlText(object);
  return text + "]\n";
}

Scene groundTruthScene(const std::string& name, const std::vector<Detection>& truth,
                       const std::vector<std::size_t>& points, std::size_t least_points) {
  Scene scene;
  scene.name = name;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Detection& object = truth[i];
    const bool hidden = object.score > 0 && object.score < least_visibility;
    if (hidden || (!points.empty() && points[i] < least_points)) {
      scene.ignore.push_back(object.object);
      continue;
    }
    GroundTruth entry;
    entry.object = object.object;
    entry.position = object.position();
    entry.reference = object.view;
    if (!object.view.empty()) entry.T_scene_reference = object.T_scene_model;
    if (object.score > 0) entry.visibility = std::min(1.0, object.score);
    if (!points.empty()) entry.points = points[i];
    scene.objects.push_back(std::move(entry));
  }
  std::sort(scene.ignore.begin(), scene.ignore.end());
  scene.ignore.erase(std::unique(scene.ignore.begin(), scene.ignore.end()), scene.ignore.end());
  return scene;
}

}  // namespace sks::tools
