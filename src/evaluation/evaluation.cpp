// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.hpp"

#include <numeric>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>
#include <sks_detector/thresholds.hpp>

#include "evaluation/peak_memory.hpp"
#include "evaluation/result_fields.hpp"
#include "evaluation/shared_scoring.hpp"

namespace sks {
namespace {

std::optional<Quantiles> quantilesOf(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Quantiles{*percentile(values, 0.5), *percentile(values, 0.9)};
}

PoseErrors summarize(const std::vector<PoseError>& errors) {
  std::vector<double> translation, rotation, t_diff;
  for (const PoseError& error : errors) {
    translation.push_back(error.translation);
    rotation.push_back(error.rotation);
    t_diff.push_back(error.t_diff);
  }
  return {errors.size(), quantilesOf(translation), quantilesOf(rotation), quantilesOf(t_diff)};
}

/// Gathers what a score is made of, over scenes.
struct Gathered {
  std::size_t ground_truth = 0;
  std::vector<RankedDetection> ranking, counted;
  std::vector<PoseError> pose_errors;

  void add(const MatchedDetection& matched, bool enough) {
    const bool hit = matched.outcome == Outcome::true_positive;
    ranking.push_back({matched.detection.score, hit});
    if (!enough) return;
    counted.push_back(ranking.back());
    if (matched.pose_error) pose_errors.push_back(*matched.pose_error);
  }

  Score score() const {
    Score result;
    result.tally = tallyAt(counted, ground_truth, 0);
    result.average_precision = averagePrecision(precisionRecallCurve(ranking, ground_truth), ground_truth);
    result.ranking = ranking;
    result.pose = summarize(pose_errors);
    return result;
  }
};

std::vector<std::pair<std::string, TimeQuantiles>> timeSpreads(const std::vector<SceneResult>& scenes) {
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  for (const auto& stage : namedTimes(StageTimes())) stages.emplace_back(stage.first, std::vector<double>());
  for (const SceneResult& scene : scenes) {
    const auto times = namedTimes(scene.times);
    for (std::size_t i = 0; i < times.size(); ++i) stages[i].second.push_back(1000 * times[i].second);
  }
  std::vector<std::pair<std::string, TimeQuantiles>> result;
  if (scenes.empty()) return result;
  for (const auto& [name, values] : stages) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    result.emplace_back(
        name, TimeQuantiles{sum / double(values.size()), *percentile(values, 0.5), *percentile(values, 0.95)});
  }
  return result;
}

DetectionResult detectInScene(const DataSet& data_set, const Scene& scene, const DetectFunction& detect) {
  try {
    return detect(readCloud(scene.path, data_set.scale));
  } catch (const Error& error) {
    throw Error(error.code(), "scene '" + scene.name + "' (" + scene.path + "): " + error.what());
  }
}

/// Makes what was found known to all processes: all that the BOP errors need of it.
void spreadFound(WorkShare& share, std::vector<std::vector<MatchedDetection>>& found) {
  std::vector<std::vector<Detection>> detections;
  for (const std::vector<MatchedDetection>& scene : found) {
    detections.emplace_back();
    for (const MatchedDetection& matched : scene) detections.back().push_back(matched.detection);
  }
  std::string bytes = bytesOf(std::move(detections));
  share.spread(bytes);
  if (share.leads()) return;
  found.clear();
  for (std::vector<Detection>& scene : fromBytes<std::vector<std::vector<Detection>>>(bytes)) {
    found.emplace_back();
    for (Detection& detection : scene) {
      found.back().emplace_back();
      found.back().back().detection = std::move(detection);
    }
  }
}

}  // namespace

std::vector<std::pair<std::string, double>> namedTimes(const StageTimes& times) {
  return {{"total", times.total},         {"sanitize", times.sanitize},        {"normals", times.normals},
          {"keypoints", times.keypoints}, {"descriptors", times.descriptors},  {"matching", times.matching},
          {"voting", times.voting},       {"verification", times.verification}};
}

Evaluation evaluate(const DataSet& data_set, const DetectFunction& detect, const std::string& method,
                    const Settings& settings, const Progress& progress, WorkShare* share) {
  if (data_set.scenes.empty()) {
    throw Error(ErrorCode::bad_data, "'" + data_set.file + "' has no scenes to evaluate; add some under 'scenes'");
  }
  Evaluation evaluation;
  evaluation.data_set = data_set.name;
  evaluation.method = method;
  evaluation.settings = settings;
  evaluation.threshold = settings.detection.threshold;
  evaluation.thresholds = Thresholds(settings.detection).ofSingleObjects();
  evaluation.max_distance = data_set.max_distance;
  const std::vector<Scene>& scenes = data_set.scenes;
  dealOut<DetectionResult>(
      share, scenes.size(), [&](std::size_t i) { return detectInScene(data_set, scenes[i], detect); },
      [&](std::size_t i, const DetectionResult& found) {
        evaluation.scenes.push_back(
            {scenes[i], matchScene(scenes[i], found.detections, data_set.max_distance), found.times, found.counts});
      },
      [&](std::size_t done) {
        report(progress, {"evaluating", done < scenes.size() ? scenes[done].name : "", done, scenes.size()});
      });
  report(progress, {"evaluating", "", scenes.size(), scenes.size()});
  scoreScenes(evaluation);
  evaluation.peak_memory_mb = peakMemoryMb();
  return evaluation;
}

bool counts(const Evaluation& evaluation, const Detection& detection) {
  const auto single = evaluation.thresholds.find(detection.object);
  return detection.score >= (single == evaluation.thresholds.end() ? evaluation.threshold : single->second);
}

void scoreScenes(Evaluation& evaluation) {
  Gathered total;
  std::map<std::string, Gathered> objects;
  for (const SceneResult& result : evaluation.scenes) {
    for (const GroundTruth& truth : result.scene.objects) {
      if (isIgnored(result.scene, truth.object)) continue;
      ++total.ground_truth;
      ++objects[truth.object].ground_truth;
    }
    for (const MatchedDetection& matched : result.detections) {
      if (matched.outcome == Outcome::ignored) continue;
      const bool enough = counts(evaluation, matched.detection);
      total.add(matched, enough);
      objects[matched.detection.object].add(matched, enough);
    }
  }
  evaluation.total = total.score();
  evaluation.objects.clear();
  for (const auto& [name, gathered] : objects) evaluation.objects[name] = gathered.score();
  evaluation.times = timeSpreads(evaluation.scenes);
}

void scoreAsBop(Evaluation& evaluation, const DataSet& data_set, const ModelLoader& loader, int threads,
                const Progress& progress) {
  scoreAsBop(evaluation, data_set, loader, threads, progress, nullptr);
}

void scoreAsBop(Evaluation& evaluation, const DataSet& data_set, const ModelLoader& loader, int threads,
                const Progress& progress, WorkShare* share) {
  std::vector<std::vector<MatchedDetection>> found;
  for (const SceneResult& scene : evaluation.scenes) found.push_back(scene.detections);
  if (share != nullptr) spreadFound(*share, found);
  evaluation.bop = bopScores(data_set, found, loader, threads, progress, share);
}

}  // namespace sks
