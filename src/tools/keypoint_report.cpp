// SPDX-License-Identifier: BSD-3-Clause
#include "tools/keypoint_report.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "core/settings/number_format.hpp"
#include "evaluation/metrics.hpp"
#include "tools/detection_json.hpp"
#include "tools/settings_json.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

using nlohmann::json;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

json jsonOrNull(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

std::vector<double> fractions(const StudiedKeypoints& kind) {
  std::vector<double> values;
  for (const StudiedPair& pair : kind.pairs) values.push_back(pair.pair.correctFraction());
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

/// Best first; pairs without a pose are left out, so that a curve ends where they begin.
std::vector<double> differences(const StudiedKeypoints& kind) {
  std::vector<double> values;
  for (const StudiedPair& pair : kind.pairs) {
    if (pair.t_diff) values.push_back(*pair.t_diff);
  }
  std::sort(values.begin(), values.end());
  return values;
}

double mean(const StudiedKeypoints& kind, const std::function<double(const KeypointPair&)>& value) {
  double sum = 0;
  for (const StudiedPair& pair : kind.pairs) sum += value(pair.pair);
  return kind.pairs.empty() ? nothing : sum / double(kind.pairs.size());
}

double meanObjectKeypoints(const StudiedKeypoints& kind) {
  return mean(kind, [](const KeypointPair& pair) { return double(pair.object_keypoints); });
}

double meanSceneKeypoints(const StudiedKeypoints& kind) {
  return mean(kind, [](const KeypointPair& pair) { return double(pair.scene_keypoints); });
}

double meanFraction(const StudiedKeypoints& kind) {
  return mean(kind, [](const KeypointPair& pair) { return pair.correctFraction(); });
}

json pairJson(const StudiedPair& pair) {
  return {{"scene", pair.scene},
          {"object", pair.object},
          {"object_keypoints", pair.pair.object_keypoints},
          {"scene_keypoints", pair.pair.scene_keypoints},
          {"correspondences", pair.pair.correspondences},
          {"inliers", pair.pair.inliers},
          {"c_rk", pair.pair.correctFraction()},
          {"t_diff", jsonOrNull(pair.t_diff)},
          {"pose", pair.pair.T_scene_object ? poseJson(*pair.pair.T_scene_object) : json()}};
}

json kindJson(const KeypointStudy& study, const StudiedKeypoints& kind) {
  json result{{"c_rk", {{"mean", meanFraction(kind)}, {"ranked", fractions(kind)}}},
              {"t_diff", {{"median", jsonOrNull(percentile(differences(kind), 0.5))}, {"ranked", differences(kind)}}},
              {"object_keypoints", {{"mean", meanObjectKeypoints(kind)}}},
              {"scene_keypoints", {{"mean", meanSceneKeypoints(kind)}}},
              {"time_ms", {{"mean", 1000 * kind.meanTime()}}},
              {"relative_time", study.relativeTime(kind)},
              {"pairs", json::array()}};
  for (const StudiedPair& pair : kind.pairs) result["pairs"].push_back(pairJson(pair));
  return result;
}

std::string csvNumber(double value) {
  return formatted("%.6g", value);
}

}  // namespace

json keypointJson(const KeypointStudy& study) {
  json result{{"dataset", study.data_set},
              {"scenes", study.scenes},
              {"pairs", study.kinds.front().pairs.size()},
              {"skipped", study.skipped},
              {"settings", settingsJson(study.settings)},
              {"keypoints", json::object()}};
  result["settings"].erase("threads");  // changes nothing but the times
  for (const StudiedKeypoints& kind : study.kinds) result["keypoints"][kind.name] = kindJson(study, kind);
  return result;
}

std::string keypointTable(const KeypointStudy& study) {
  Table table({"<keypoints", "of object", "of scene", "mean C_rk", "median T_diff", "T_diff < 0.1", "poses",
               "time [ms]", "relative"});
  for (const StudiedKeypoints& kind : study.kinds) {
    const std::vector<double> t_diff = differences(kind);
    const auto good = std::count_if(t_diff.begin(), t_diff.end(), [](double value) { return value < 0.1; });
    table.add({kind.name, fixed(meanObjectKeypoints(kind), 0), fixed(meanSceneKeypoints(kind), 0),
               fixed(meanFraction(kind), 3), fixed(percentile(t_diff, 0.5).value_or(nothing), 3), std::to_string(good),
               std::to_string(t_diff.size()), fixed(1000 * kind.meanTime(), 2), fixed(study.relativeTime(kind), 4)});
  }
  return study.data_set + ": " + std::to_string(study.kinds.front().pairs.size()) + " pairs of object and scene in " +
         std::to_string(study.scenes) + " scenes\n\n" + table.text();
}

std::string keypointCsv(const KeypointStudy& study) {
  std::string text = "keypoints,rank,c_rk,t_diff\n";
  for (const StudiedKeypoints& kind : study.kinds) {
    const std::vector<double> c_rk = fractions(kind), t_diff = differences(kind);
    for (std::size_t i = 0; i < c_rk.size(); ++i) {
      text += kind.name + "," + std::to_string(i + 1) + "," + csvNumber(c_rk[i]) + "," +
              (i < t_diff.size() ? csvNumber(t_diff[i]) : "") + "\n";
    }
  }
  return text;
}

}  // namespace sks::tools
