// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/scene_detector.hpp"

#include <utility>

#include "baselines/nearest_matches.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/to_detection.hpp"

namespace sks::baselines {

SceneDetector::SceneDetector(std::shared_ptr<const Codebook> codebook, const Settings& settings, const Stages& stages)
    : describer_{codebook, settingsFor(*codebook, settings), completed(stages, *codebook), nearestMatches(*codebook)} {}

DetectionResult SceneDetector::detect(const Cloud& cloud) const {
  const auto& [codebook, settings, stages, match] = describer_;
  StageClock clock;
  const auto [scene, counts] = describer_.describe(cloud, Orientation::sensor, clock);
  std::vector<Hypothesis> hypotheses =
      clock.book(&StageTimes::voting, stages.verifier->propose(scene, *codebook, settings));
  hypotheses =
      clock.book(&StageTimes::verification, stages.verifier->verify(std::move(hypotheses), scene, *codebook, settings));
  DetectionResult result;
  for (const Hypothesis& hypothesis : hypotheses) {
    result.detections.push_back(toDetection(*codebook, hypothesis, stages.verifier->score(hypothesis, settings)));
  }
  result.counts = counts;
  result.counts.hypotheses = result.detections.size();
  result.times = clock.times();
  return result;
}

}  // namespace sks::baselines
