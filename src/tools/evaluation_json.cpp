// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluation_json.hpp"

#include "drawing/palette.hpp"
#include "tools/detection_json.hpp"
#include "tools/settings_json.hpp"

namespace sks::tools {
namespace {

using nlohmann::json;

json orNull(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

json tallyJson(const Tally& tally) {
  return {{"true_positives", tally.true_positives},
          {"false_positives", tally.false_positives},
          {"precision", orNull(tally.precision())},
          {"recall", orNull(tally.recall())},
          {"f1", orNull(tally.f1())}};
}

json pointJson(const CurvePoint& point) {
  json result = tallyJson(point.tally);
  result["threshold"] = point.threshold;
  return result;
}

json quantilesJson(const std::optional<Quantiles>& quantiles) {
  if (!quantiles) return {{"median", nullptr}, {"p90", nullptr}};
  return {{"median", quantiles->median}, {"p90", quantiles->p90}};
}

/// Parallel lists of threshold, precision and recall.
json curveJson(const std::vector<CurvePoint>& curve) {
  json result{{"threshold", json::array()}, {"precision", json::array()}, {"recall", json::array()}};
  for (const CurvePoint& point : curve) {
    result["threshold"].push_back(point.threshold);
    result["precision"].push_back(orNull(point.tally.precision()));
    result["recall"].push_back(orNull(point.tally.recall()));
  }
  return result;
}

json scoreJson(const Score& score) {
  json result = tallyJson(score.tally);
  const std::vector<CurvePoint> curve = precisionRecallCurve(score.ranking, score.tally.ground_truth);
  const std::optional<CurvePoint> best = bestPoint(curve);
  result["ground_truth"] = score.tally.ground_truth;
  result["average_precision"] = orNull(score.average_precision);
  result["pose"] = {{"count", score.pose.count},
                    {"translation_error_m", quantilesJson(score.pose.translation)},
                    {"rotation_error_deg", quantilesJson(score.pose.rotation)},
                    {"t_diff", quantilesJson(score.pose.t_diff)}};
  result["best"] = best ? pointJson(*best) : json();
  result["curve"] = curveJson(curve);
  return result;
}

json groundTruthJson(const SceneResult& result, std::size_t index, const Evaluation& evaluation) {
  const GroundTruth& truth = result.scene.objects[index];
  bool detected = false;
  for (const MatchedDetection& matched : result.detections) {
    detected = detected || (matched.ground_truth == index && counts(evaluation, matched.detection));
  }
  return {{"object", truth.object},
          {"position", vectorJson(truth.position)},
          {"visibility", orNull(truth.visibility)},
          {"points", truth.points ? json(*truth.points) : json()},
          {"ignored", isIgnored(result.scene, truth.object)},
          {"detected", detected}};
}

json matchedJson(const MatchedDetection& matched) {
  json result = detectionJson(matched.detection);
  result["ignored"] = matched.outcome == Outcome::ignored;
  result["true_positive"] = matched.outcome == Outcome::true_positive;
  if (matched.pose_error) {
    result["pose_error"] = {{"translation_error_m", matched.pose_error->translation},
                            {"rotation_error_deg", matched.pose_error->rotation},
                            {"t_diff", matched.pose_error->t_diff}};
  }
  return result;
}

json sceneJson(const SceneResult& scene, const Evaluation& evaluation) {
  json result{{"name", scene.scene.name}, {"ground_truth", json::array()}, {"detections", json::array()}};
  for (std::size_t i = 0; i < scene.scene.objects.size(); ++i) {
    result["ground_truth"].push_back(groundTruthJson(scene, i, evaluation));
  }
  for (const MatchedDetection& matched : scene.detections) result["detections"].push_back(matchedJson(matched));
  return result;
}

json bopJson(const BopRecall& recall) {
  return {{"targets", recall.targets},
          {"vsd", orNull(recall.vsd)},
          {"mssd", orNull(recall.mssd)},
          {"mspd", orNull(recall.mspd)},
          {"ar", orNull(recall.ar)}};
}

/// Over all objects into `bop`, of each object into that of its own.
void addBop(const BopScores& scores, json& result) {
  result["bop"] = bopJson(scores.total);
  result["bop"]["not_available"] = scores.shortcomings;
  for (const auto& [object, recall] : scores.objects) result["per_object"][object]["bop"] = bopJson(recall);
}

/// What stands in the results of any evaluation, whoever detected.
json commonJson(const Evaluation& evaluation, const std::vector<std::string>& objects) {
  json result = scoreJson(evaluation.total);
  result["dataset"] = evaluation.data_set;
  result["method"] = evaluation.method;
  result["scenes"] = evaluation.scenes.size();
  result["threshold"] = evaluation.threshold;
  result["thresholds"] = evaluation.thresholds;
  result["max_distance"] = evaluation.max_distance;
  for (const auto& [stage, time] : evaluation.times) {
    result["time_ms"][stage] = {{"mean", time.mean}, {"p50", time.p50}, {"p95", time.p95}};
  }
  result["threshold_sweep"] = json::array();
  for (const CurvePoint& point : thresholdSweep(evaluation.total.ranking, evaluation.total.tally.ground_truth)) {
    result["threshold_sweep"].push_back(pointJson(point));
  }
  result["per_object"] = json::object();
  for (const auto& [object, score] : evaluation.objects) {
    json& of_object = result["per_object"][object] = scoreJson(score);
    of_object["color"] = hexText(objectColor(objects, object));
  }
  if (evaluation.bop) addBop(*evaluation.bop, result);
  result["per_scene"] = json::array();
  for (const SceneResult& scene : evaluation.scenes) {
    result["per_scene"].push_back(sceneJson(scene, evaluation));
  }
  return result;
}

}  // namespace

json evaluationJson(const Evaluation& evaluation, const std::vector<std::string>& objects) {
  json result = commonJson(evaluation, objects);
  result["settings"] = settingsJson(evaluation.settings);
  result["settings"].erase("threads");  // changes nothing but the times
  result["peak_memory_mb"] = evaluation.peak_memory_mb;
  for (std::size_t i = 0; i < evaluation.scenes.size(); ++i) {
    result["per_scene"][i]["time_ms"] = timesJson(evaluation.scenes[i].times);
    result["per_scene"][i]["counts"] = countsJson(evaluation.scenes[i].counts);
  }
  return result;
}

json recordedJson(const Evaluation& evaluation) {
  std::vector<std::string> objects;
  for (const auto& [object, score] : evaluation.objects) objects.push_back(object);
  json result = commonJson(evaluation, objects);
  for (std::size_t i = 0; i < evaluation.scenes.size(); ++i) {
    result["per_scene"][i]["time_ms"] = {{"total", 1000 * evaluation.scenes[i].times.total}};
  }
  return result;
}

}  // namespace sks::tools
