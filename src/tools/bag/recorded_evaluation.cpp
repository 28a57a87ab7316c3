// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag/recorded_evaluation.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "tools/bag/stamps.hpp"
#include "tools/data_set_yaml.hpp"

namespace sks::tools {
namespace {

/// References are named as seen from a data set file, views as seen by whoever trained: the file's name must do.
bool sameModel(const std::string& a, const std::string& b) {
  return !a.empty() && std::filesystem::path(a).filename() == std::filesystem::path(b).filename();
}

void nameReferencesLikeViews(Scene& scene, const std::vector<Detection>& detections) {
  for (GroundTruth& truth : scene.objects) {
    for (const Detection& detection : detections) {
      const bool same = detection.object == truth.object && sameModel(truth.reference, detection.view);
      if (same) truth.reference = detection.view;
    }
  }
}

/// What looks like a codebook that does not go with the truth.
std::vector<std::string> oddNames(const RecordedTruth& truth, const RecordedDetections& found) {
  std::set<std::string> true_names, found_names;
  for (const auto& [stamp, scene] : truth.scenes) {
    for (const GroundTruth& object : scene.objects) true_names.insert(object.object);
    true_names.insert(scene.ignore.begin(), scene.ignore.end());
  }
  std::string codebook;
  for (const auto& [stamp, array] : found.arrays) {
    for (const Detection& detection : array.detections) found_names.insert(detection.object);
    codebook = array.codebook;
  }
  const std::string by = codebook.empty() ? "" : " (codebook " + codebook + ")";
  std::vector<std::string> warnings;
  for (const std::string& name : true_names) {
    if (!found_names.count(name)) {
      warnings.push_back("object '" + name + "' of the ground truth is never detected" + by + ": was it trained?");
    }
  }
  for (const std::string& name : found_names) {
    if (!true_names.count(name)) {
      warnings.push_back("object '" + name + "' is detected" + by +
                         " but is nowhere in the ground truth: false alarms");
    }
  }
  return warnings;
}

}  // namespace

RecordedTruth truthFromArrays(const std::string& bag, const RecordedDetections& truth, const RecordedDetections& found,
                              double max_distance) {
  RecordedTruth result;
  result.name = std::filesystem::path(bag).filename().string();
  result.max_distance = max_distance;
  for (const auto& [stamp, array] : truth.arrays) {
    const auto other = found.arrays.find(stamp);
    if (other != found.arrays.end() && other->second.frame != array.frame) {
      throw Error(ErrorCode::bad_data, found.topic + " is in frame '" + other->second.frame + "', " + truth.topic +
                                           " in '" + array.frame +
                                           "': record detections without ~target_frame to compare them");
    }
    result.scenes[stamp] = groundTruthScene(stampText(stamp), array.detections);
  }
  return result;
}

void addSymmetries(const DataSet& data_set, RecordedTruth& truth) {
  for (auto& [stamp, scene] : truth.scenes) {
    for (GroundTruth& object : scene.objects) {
      for (const TrainingEntry& entry : data_set.training) {
        const bool same = entry.object == object.object && sameModel(object.reference, entry.source);
        if (same) object.symmetry = entry.symmetry;
      }
    }
  }
}

RecordedTruth truthFromDataSet(const DataSet& data_set, const std::vector<ros::Time>& stamps) {
  RecordedTruth result;
  result.name = data_set.name;
  result.max_distance = data_set.max_distance;
  const auto named_by_stamp = [](const Scene& scene) { return parseStamp(scene.name).has_value(); };
  if (std::all_of(data_set.scenes.begin(), data_set.scenes.end(), named_by_stamp)) {
    for (const Scene& scene : data_set.scenes) result.scenes[*parseStamp(scene.name)] = scene;
    return result;
  }
  if (stamps.size() != data_set.scenes.size()) {
    throw Error(ErrorCode::bad_data, "'" + data_set.file + "' has " + std::to_string(data_set.scenes.size()) +
                                         " scenes, the bag " + std::to_string(stamps.size()) +
                                         " stamps: call each scene by the stamp of its cloud, e.g. " +
                                         stampText(stamps.empty() ? ros::Time(1500000000, 0) : stamps.front()) +
                                         ", as `sks bag extract` does");
  }
  for (std::size_t i = 0; i < stamps.size(); ++i) result.scenes[stamps[i]] = data_set.scenes[i];
  return result;
}

RecordedEvaluation evaluateRecorded(const RecordedTruth& truth, const RecordedDetections& found, double threshold,
                                    bool count_unanswered) {
  RecordedEvaluation result;
  Evaluation& evaluation = result.evaluation;
  evaluation.data_set = truth.name;
  evaluation.method = found.topic;
  evaluation.threshold = threshold;
  evaluation.max_distance = truth.max_distance;
  std::size_t answered = 0;
  for (const auto& [stamp, scene] : truth.scenes) {
    const auto entry = found.arrays.find(stamp);
    const bool has_answer = entry != found.arrays.end();
    ++(has_answer ? answered : result.unanswered);
    if (!has_answer && !count_unanswered) continue;
    const RecordedArray array = has_answer ? entry->second : RecordedArray();
    SceneResult scored;
    scored.scene = scene;
    nameReferencesLikeViews(scored.scene, array.detections);
    scored.detections = matchScene(scored.scene, array.detections, truth.max_distance);
    scored.times.total = array.processing_time;
    evaluation.scenes.push_back(std::move(scored));
    result.stamps.push_back(stamp);
  }
  if (answered == 0) {
    throw Error(ErrorCode::bad_data,
                "none of the " + std::to_string(found.arrays.size()) + " arrays of " + found.topic +
                    " has the stamp of one of the " + std::to_string(truth.scenes.size()) +
                    " clouds with ground truth" +
                    (truth.scenes.empty() ? "" : ", of which the first is " + stampText(truth.scenes.begin()->first)) +
                    ": do both come from the same recording?");
  }
  scoreScenes(evaluation);
  evaluation.times.resize(1);
  result.warnings = oddNames(truth, found);
  return result;
}

}  // namespace sks::tools
