// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bop_results.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"

namespace sks::tools {
namespace {

/// The number that a text is; -1 where it is none.
int numberOf(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 9 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::stoi(text) : -1;
}

int objectNumber(const std::string& name) {
  const int number = numberOf(name.compare(0, 4, "obj_") == 0 ? name.substr(4) : name);
  if (number >= 0) return number;
  throw Error(ErrorCode::bad_data, "--bop-results: object '" + name +
                                       "' must be called obj_<number>, as sks import bop "
                                       "calls it");
}

std::pair<int, int> imageNumbers(const std::string& scene) {
  const std::size_t slash = scene.find('/');
  const int first = numberOf(scene.substr(0, slash));
  const int second = slash == std::string::npos ? -1 : numberOf(scene.substr(slash + 1));
  if (first >= 0 && second >= 0) return {first, second};
  throw Error(ErrorCode::bad_data, "--bop-results: scene '" + scene +
                                       "' must be called <scene>/<image>, two numbers, "
                                       "as sks import bop calls it");
}

void checkFrame(const DataSet& data_set, const Detection& detection) {
  const bool mesh = std::any_of(data_set.training.begin(), data_set.training.end(), [&](const TrainingEntry& entry) {
    return entry.mesh && entry.source == detection.view && entry.object == detection.object;
  });
  if (mesh) return;
  throw Error(ErrorCode::bad_data, "--bop-results: the pose of '" + detection.object + "' is in the frame of '" +
                                       detection.view + "', which is no mesh of the data set: train from its models");
}

std::string numbers(const double* values, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += formatted("%s%.8g", i > 0 ? " " : "", values[i]);
  }
  return text;
}

std::string line(const std::pair<int, int>& image, const Detection& detection, double seconds) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = detection.T_scene_model.linear();
  const Eigen::Vector3d t = 1000 * detection.T_scene_model.translation();
  return std::to_string(image.first) + "," + std::to_string(image.second) + "," +
         std::to_string(objectNumber(detection.object)) + "," + numbers(&detection.score, 1) + "," +
         numbers(R.data(), 9) + "," + numbers(t.data(), 3) + "," + numbers(&seconds, 1) + "\n";
}

}  // namespace

void checkBopNames(const DataSet& data_set) {
  for (const Scene& scene : data_set.scenes) imageNumbers(scene.name);
  for (const TrainingEntry& entry : data_set.training) objectNumber(entry.object);
}

std::string bopResults(const DataSet& data_set, const Evaluation& evaluation) {
  std::string text = "scene_id,im_id,obj_id,score,R,t,time\n";
  for (const SceneResult& result : evaluation.scenes) {
    const std::pair<int, int> image = imageNumbers(result.scene.name);
    for (const MatchedDetection& matched : result.detections) {
      checkFrame(data_set, matched.detection);
      text += line(image, matched.detection, result.times.total);
    }
  }
  return text;
}

}  // namespace sks::tools
