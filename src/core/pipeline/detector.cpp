// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detector.hpp>

#include <algorithm>
#include <optional>
#include <tuple>

#include "core/matching/object_matching.hpp"
#include "core/pipeline/scene_description.hpp"
#include "core/pipeline/stopwatch.hpp"
#include "core/verification/refinement.hpp"
#include "core/verification/score.hpp"
#include "core/verification/verification.hpp"
#include "core/voting/hough_hypotheses.hpp"

namespace sks {
namespace {

Detection toDetection(const Codebook& codebook, const Hypothesis& hypothesis, const Settings& settings) {
  Detection detection;
  detection.object = codebook.objects[hypothesis.object];
  detection.view = codebook.views[hypothesis.view].frameName();
  detection.T_scene_model = hypothesis.T_scene_model;
  detection.T_scene_box = hypothesis.T_scene_box;
  detection.box_size = hypothesis.box_size;
  detection.density = hypothesis.density;
  detection.evidence = hypothesis.evidence;
  detection.votes = hypothesis.votes;
  detection.inliers = std::uint32_t(hypothesis.inliers.size());
  detection.score = score(hypothesis, settings);
  return detection;
}

Inspection inspectionOf(const SceneDescription& scene) {
  Inspection inspection{scene.keypoints.positions, {}, {}};
  for (std::size_t object = 0; object < scene.votes.size(); ++object) {
    for (const Vote& vote : scene.votes[object]) {
      if (vote.weight < 1) continue;  // of the nearest codewords only
      inspection.votes.push_back(vote.position);
      inspection.vote_objects.push_back(std::uint32_t(object));
    }
  }
  return inspection;
}

bool better(const Detection& a, const Detection& b) {
  const auto key = [](const Detection& d) {
    return std::make_tuple(-d.score, std::cref(d.object), d.position().x(), d.position().y(), d.position().z());
  };
  return key(a) < key(b);
}

}  // namespace

Detector::Detector(std::shared_ptr<const Codebook> codebook, const Settings& settings)
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      matcher_(std::make_shared<ObjectMatcher>(*codebook_)),
      verifier_(std::make_shared<Verifier>(codebook_)) {}

Detector Detector::withSettings(const Settings& settings) const {
  Detector other = *this;
  other.settings_ = settingsFor(*codebook_, settings);
  return other;
}

DetectionResult Detector::detect(const Cloud& cloud, Inspection* inspection) const {
  const int threads = threadCount(settings_);
  DetectionResult result;
  StageTimes& times = result.times;
  Stopwatch total;
  const bool verifies = settings_.detection.hypotheses == Hypotheses::verified;
  const double ambiguity = verifies ? settings_.matching.ambiguity : 1.0;
  const auto match = [&](const DescriptorMatrix& d, int n) { return matcher_->match(d, ambiguity, n); };
  SceneDescription scene;
  scene.surface = prepareScene(cloud, Orientation::sensor, *codebook_, settings_, times, result.counts);

  Stopwatch stage;
  std::optional<SceneView> view;
  KeypointFilter filter;
  if (verifies) view.emplace(scene.surface, settings_, threads);
  if (verifies && settings_.keypoints.skip_planes) {
    filter = [&](const Keypoints& k) { return keypointsOffPlanes(k, view->planes, verifier_->largestExtent()); };
  }
  times.verification = stage.lap();
  describeSurface(scene, *codebook_, match, settings_, filter, times, result.counts);
  if (inspection) *inspection = inspectionOf(scene);

  stage.lap();
  std::vector<Hypothesis> hypotheses;
  if (verifies) {
    hypotheses = verifier_->findPoses(scene.votes, *view, settings_, threads);
  } else {
    const auto maxima = findAllMaxima(scene.votes, settings_, threads);
    times.voting += stage.lap();
    hypotheses = houghHypotheses(*codebook_, scene.votes, maxima, settings_);
    if (settings_.refinement.iterations > 0) {
      refineHypotheses(hypotheses, *codebook_, scene.surface, settings_.refinement, threads);
    }
  }
  for (const Hypothesis& hypothesis : hypotheses) {
    result.detections.push_back(toDetection(*codebook_, hypothesis, settings_));
  }
  std::sort(result.detections.begin(), result.detections.end(), better);
  times.verification += stage.lap();
  times.total = total.lap();
  result.counts.hypotheses = result.detections.size();
  return result;
}

}  // namespace sks
