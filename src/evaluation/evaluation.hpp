// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/detection.hpp>
#include <sks_detector/detector.hpp>
#include <sks_detector/progress.hpp>
#include <sks_detector/settings.hpp>

#include "core/sharing/work_share.hpp"
#include "evaluation/bop_scores.hpp"
#include "evaluation/metrics.hpp"
#include "evaluation/scene_matching.hpp"
#include "io/dataset.hpp"

namespace sks {

/// What was found in one scene.
struct SceneResult {
  Scene scene;                               ///< with its ground truth
  std::vector<MatchedDetection> detections;  ///< every hypothesis, whatever its score, best first
  StageTimes times;                          ///< [s]
  StageCounts counts;
};

/// Median and 90th percentile.
struct Quantiles {
  double median = 0;
  double p90 = 0;
};

/// Pose errors of those true positives at the threshold that have one (MatchedDetection::pose_error).
struct PoseErrors {
  std::size_t count = 0;
  std::optional<Quantiles> translation;  ///< [m]
  std::optional<Quantiles> rotation;     ///< [deg]
  std::optional<Quantiles> t_diff;
};

/// How one object, or all of them pooled, came off.
struct Score {
  Tally tally;                              ///< at the threshold
  std::optional<double> average_precision;  ///< over all scores
  std::vector<RankedDetection> ranking;     ///< every detection that counts, of any score
  PoseErrors pose;
};

/// Mean and percentiles of a stage's time over the scenes [ms].
struct TimeQuantiles {
  double mean = 0, p50 = 0, p95 = 0;
};

/// The outcome of an evaluation.
struct Evaluation {
  std::string data_set;  ///< name
  std::string method;    ///< name
  Settings settings;     ///< what the detections were made with
  double threshold = 0;  ///< the fixed score from which on detections count: settings.detection.threshold
  std::map<std::string, double> thresholds;  ///< and in its place for single objects: settings.detection.thresholds
  double max_distance = 0;                   ///< of the matching rule [m]
  Score total;                               ///< all objects pooled
  std::map<std::string, Score> objects;      ///< every object of the ground truth or of a detection
  std::vector<SceneResult> scenes;           ///< in the order of the data set
  std::vector<std::pair<std::string, TimeQuantiles>>
      times;                  ///< of each stage, `total` first; reading files not counted
  double peak_memory_mb = 0;  ///< greatest resident size of the process so far [MiB]

  std::optional<BopScores> bop;  ///< of scoreAsBop()
};

/// Detects in every scene and scores what is found.
/// @param method name that stands in the result
/// @param settings that `detect` works with; its detection.threshold and thresholds are the fixed ones
/// @param progress called before each scene and once at the end
/// @param share where given, its processes detect; only the leader's result is whole
/// @throws Error(bad_data) for a data set without scenes; any error of reading or detecting with the name of the scene
///         and its file; Error(cancelled)
Evaluation evaluate(const DataSet& data_set, const DetectFunction& detect, const std::string& method,
                    const Settings& settings, const Progress& progress = {}, WorkShare* share = nullptr);

/// Whether the score of a detection is enough to count.
bool counts(const Evaluation& evaluation, const Detection& detection);

/// The part of evaluate() that scores what was found: fills in total, objects and times from the scenes.
void scoreScenes(Evaluation& evaluation);

/// Fills in the average recalls of the BOP challenge. @param threads change nothing @throws what bopScores() throws
void scoreAsBop(Evaluation& evaluation, const DataSet& data_set, const ModelLoader& loader, int threads,
                const Progress& progress = {});

/// Name and seconds of each stage, `total` first, then in the order of the stages.
std::vector<std::pair<std::string, double>> namedTimes(const StageTimes& times);

}  // namespace sks
