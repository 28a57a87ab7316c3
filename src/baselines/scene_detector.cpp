// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/scene_detector.hpp"

#include <utility>

#include "core/pipeline/scene_description.hpp"
#include "core/pipeline/stopwatch.hpp"

namespace sks::baselines {
namespace {

Detection toDetection(const Codebook& codebook, const RatedHypothesis& rated, double half_support) {
  const Hypothesis& hypothesis = rated.hypothesis;
  Detection detection;
  detection.object = codebook.objects[hypothesis.object];
  detection.score = rated.support / (rated.support + half_support);
  detection.view = codebook.views[hypothesis.view].frameName();
  detection.T_scene_model = hypothesis.T_scene_model;
  detection.T_scene_box = hypothesis.T_scene_box;
  detection.box_size = hypothesis.box_size;
  detection.density = rated.support;
  detection.votes = hypothesis.votes;
  detection.inliers = std::uint32_t(hypothesis.inliers.size());
  return detection;
}

}  // namespace

SceneDetector::SceneDetector(std::shared_ptr<const Codebook> codebook, const Settings& settings, Grouping grouping,
                             HypothesisCheck check, double half_support)
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      matcher_(codebook_->descriptors),
      models_(*codebook_),
      grouping_(std::move(grouping)),
      check_(std::move(check)),
      half_support_(half_support) {}

DetectionResult SceneDetector::detect(const Cloud& cloud) const {
  const int threads = threadCount(settings_);
  DetectionResult result;
  Stopwatch total;
  const auto match = [this](const DescriptorMatrix& d, int n) { return matcher_.match(d, n); };
  const SceneDescription scene =
      describeScene(cloud, Orientation::sensor, *codebook_, match, settings_, result.times, result.counts);

  Stopwatch stage;
  std::vector<RatedHypothesis> hypotheses = groupedHypotheses(*codebook_, models_, scene, grouping_, threads);
  result.times.voting += stage.lap();
  if (check_) hypotheses = check_(std::move(hypotheses), scene.surface);
  for (const RatedHypothesis& rated : withoutDuplicates(std::move(hypotheses), settings_.voting.suppression_radius)) {
    result.detections.push_back(toDetection(*codebook_, rated, half_support_));
  }
  result.times.verification = stage.lap();
  result.times.total = total.lap();
  result.counts.hypotheses = result.detections.size();
  return result;
}

}  // namespace sks::baselines
