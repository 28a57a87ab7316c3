// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detector.hpp>

#include <algorithm>
#include <tuple>

#include <sks_detector/error.hpp>
#include <sks_detector/sanitize.hpp>
#include <sks_detector/voting.hpp>

#include "core/hough_hypotheses.hpp"
#include "core/score.hpp"
#include "core/stopwatch.hpp"
#include "core/verification.hpp"

namespace sks {
namespace {

Settings checkedSettings(const Codebook& codebook, Settings settings) {
  validate(settings);
  if (settings.descriptor.type == DescriptorType::automatic) settings.descriptor.type = codebook.descriptor_type;
  std::string conflicts;
  for (const std::string& key : bindingConflicts(codebook.settings, settings)) {
    conflicts += (conflicts.empty() ? "" : ", ") + key + " = " + getSetting(codebook.settings, key) + " (not " +
                 getSetting(settings, key) + ")";
  }
  if (!conflicts.empty()) {
    throw Error(ErrorCode::incompatible, "the codebook '" + codebook.name + "' was trained with " + conflicts +
                                             ": use the same values, or train again");
  }
  return settings;
}

Keypoints sceneKeypoints(const Surface& surface, const Settings& settings, int threads, StageCounts& counts) {
  Keypoints keypoints = detectKeypoints(surface, settings.keypoints, threads);
  counts.grid_keypoints = keypoints.size();
  const bool selects = settings.keypoints.selection != SelectionRule::rank || settings.keypoints.discard > 0;
  if (settings.keypoints.detector == KeypointDetector::grid && selects) {
    measureCurvature(surface, keypoints, settings.keypoints, settings.surface, threads);
    keypoints = selectKeypoints(keypoints, settings.keypoints);
  }
  counts.keypoints = keypoints.size();
  return keypoints;
}

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

void inspect(const Keypoints& keypoints, const std::vector<std::vector<Vote>>& spaces, Inspection& inspection) {
  inspection = {keypoints.positions, {}, {}};
  for (std::size_t object = 0; object < spaces.size(); ++object) {
    for (const Vote& vote : spaces[object]) {
      inspection.votes.push_back(vote.position);
      inspection.vote_objects.push_back(std::uint32_t(object));
    }
  }
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
      settings_(checkedSettings(*codebook_, settings)),
      matcher_(std::make_shared<Matcher>(codebook_->descriptors)),
      verifier_(std::make_shared<Verifier>(codebook_)) {}

Detector Detector::withSettings(const Settings& settings) const {
  Detector other = *this;
  other.settings_ = checkedSettings(*codebook_, settings);
  return other;
}

DetectionResult Detector::detect(const Cloud& cloud, Inspection* inspection) const {
  const int threads = threadCount(settings_);
  DetectionResult result;
  StageTimes& times = result.times;
  StageCounts& counts = result.counts;
  Stopwatch total, stage;

  if (codebook_->descriptor_type == DescriptorType::cshot && !cloud.hasColor()) {
    throw Error(ErrorCode::incompatible,
                "the codebook '" + codebook_->name +
                    "' describes colour (CSHOT), but the cloud has none: use a coloured cloud, or "
                    "train with --set descriptor.type=shot");
  }
  const Cloud sanitized = sanitize(cloud, settings_.sanitize);
  times.sanitize = stage.lap();

  const Surface surface = prepareSurface(sanitized, settings_.surface, Orientation::sensor, threads);
  times.normals = stage.lap();

  const Keypoints keypoints = sceneKeypoints(surface, settings_, threads, counts);
  times.keypoints = stage.lap();

  const Descriptors descriptors =
      computeDescriptors(surface, keypoints, codebook_->descriptor_type, settings_.descriptor, threads);
  times.descriptors = stage.lap();

  const std::vector<Match> matches = matcher_->match(descriptors.values, threads);
  times.matching = stage.lap();

  const auto votes = castVotes(*codebook_, matches, descriptors, keypoints);
  if (inspection) inspect(keypoints, votes, *inspection);
  std::vector<Hypothesis> hypotheses;
  if (settings_.verification.candidates > 0) {
    times.voting = stage.lap();
    hypotheses = verifier_->findPoses(votes, surface, settings_, threads);
  } else {
    const auto maxima = findAllMaxima(votes, settings_, threads);
    times.voting = stage.lap();
    hypotheses = houghHypotheses(*codebook_, votes, maxima, surface, settings_, threads);
  }
  for (const Hypothesis& hypothesis : hypotheses) {
    result.detections.push_back(toDetection(*codebook_, hypothesis, settings_));
  }
  std::sort(result.detections.begin(), result.detections.end(), better);
  times.verification = stage.lap();
  times.total = total.lap();

  counts.input_points = cloud.size();
  counts.points = surface.size();
  counts.descriptors = descriptors.keypoints.size();
  counts.votes = matches.size();
  counts.hypotheses = result.detections.size();
  return result;
}

std::vector<Detection> DetectionResult::above(double threshold) const {
  std::vector<Detection> kept;
  std::copy_if(detections.begin(), detections.end(), std::back_inserter(kept),
               [&](const Detection& d) { return d.score >= threshold; });
  return kept;
}

}  // namespace sks
