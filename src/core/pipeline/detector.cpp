// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/detector.hpp>

#include <algorithm>
#include <future>
#include <limits>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/keypoints/range_thinning.hpp"
#include "core/matching/background_words.hpp"
#include "core/matching/object_matching.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/pipeline/scene_description.hpp"
#include "core/pipeline/stage_clock.hpp"
#include "core/pipeline/to_detection.hpp"
#include "core/settings/threads.hpp"
#include "core/verification/hough_verifier.hpp"
#include "core/verification/verification.hpp"

namespace sks {
namespace {

constexpr float any_plane = std::numeric_limits<float>::infinity();

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

std::vector<Detection> ranked(const std::vector<Hypothesis>& hypotheses, const Codebook& codebook,
                              const VerifierStage& verifier, const Settings& settings) {
  std::vector<Detection> detections;
  for (const Hypothesis& hypothesis : hypotheses) {
    detections.push_back(toDetection(codebook, hypothesis, verifier.score(hypothesis, settings)));
  }
  std::sort(detections.begin(), detections.end(), better);
  return detections;
}

std::vector<LargePlane> planesOf(const Surface& surface, const Settings& settings) {
  return verifiesPoses(settings) ? findLargePlanes(surface, threadCount(settings)) : std::vector<LargePlane>();
}

/// Where no keypoints are to be left out, none are. A thinned cloud is as dense far away as near the sensor.
bool thinsByRange(const Settings& settings) {
  const KeypointSettings& keypoints = settings.keypoints;
  const bool keeps_all = keypoints.selection == SelectionRule::rank && keypoints.discard == 0;
  return skipsPlanes(settings) && !keeps_all && settings.surface.resolution == 0;
}

/// The keypoints in none of the boxes.
Keypoints keypointsOutside(const std::vector<OccupiedBox>& occupied, Keypoints keypoints) {
  if (occupied.empty()) return keypoints;
  Keypoints kept;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const Eigen::Vector3d position = keypoints.positions[i].cast<double>();
    if (std::any_of(occupied.begin(), occupied.end(), [&](const auto& box) { return box.contains(position); }))
      continue;
    kept.positions.push_back(keypoints.positions[i]);
    if (!keypoints.normals.empty()) kept.normals.push_back(keypoints.normals[i]);
    if (!keypoints.curvature.empty()) kept.curvature.push_back(keypoints.curvature[i]);
  }
  return kept;
}

/// Calls a function that uses one thread while the calling thread does something else, or else when the result is asked
/// for.
template <typename Function>
auto builtBeside(const Function& function, const Settings& settings) {
  if (threadCount(settings) > 1) {
    try {
      return std::async(std::launch::async, function);
    } catch (const std::system_error&) {  // no thread can be started: it takes longer
    }
  }
  return std::async(std::launch::deferred, function);
}

}  // namespace

Detector::Detector(std::shared_ptr<const Codebook> codebook) : Detector(codebook, codebook->settings) {}

Detector::Detector(Codebook codebook) : Detector(std::make_shared<const Codebook>(std::move(codebook))) {}

Detector::Detector(Codebook codebook, const Settings& settings, const Stages& stages)
    : Detector(std::make_shared<const Codebook>(std::move(codebook)), settings, stages) {}

Detector::Detector(std::shared_ptr<const Codebook> codebook, const Settings& settings, const Stages& stages)
    : codebook_(std::move(codebook)),
      settings_(settingsFor(*codebook_, settings)),
      stages_(completed(stages, *codebook_)) {
  auto matcher = builtBeside([this] { return std::make_shared<const ObjectMatcher>(*codebook_); }, settings_);
  findBackground();
  if (!stages_.verifier) {
    models_ = std::make_shared<VerifiedModels>(codebook_, threadCount(settings_));
    surface_verifier_ = std::make_shared<SurfaceVerifier>(models_);
    hough_verifier_ = std::make_shared<HoughVerifier>(*codebook_);
  }
  matcher_ = matcher.get();
}

Detector Detector::withSettings(const Settings& settings) const {
  Detector other = *this;
  other.settings_ = settingsFor(*codebook_, settings);
  other.findBackground();
  return other;
}

void Detector::findBackground() {
  background_ = hasBackground(*codebook_, settings_) ? backgroundWords(*codebook_, settings_) : nullptr;
}

const VerifierStage& Detector::verifier() const {
  if (stages_.verifier) return *stages_.verifier;
  return verifiesPoses(settings_) ? *surface_verifier_ : *hough_verifier_;
}

DetectionResult Detector::detect(const Cloud& cloud, Inspection* inspection,
                                 const std::vector<OccupiedBox>& occupied) const {
  using Times = StageTimes;
  const int threads = startableThreads(settings_);
  const float largest_plane = skipsPlanes(settings_) ? codebook_->largestExtent() : any_plane;
  StageClock clock;
  SceneDescription scene;

  // Section 3.1: usable points, thinned, with normals towards the sensor.
  const Cloud usable = clock.book(&Times::sanitize, usableCloud(cloud, Orientation::sensor, *codebook_, settings_));
  scene.surface = clock.book(&Times::normals, prepareScene(usable, settings_.surface, threads));
  // Beyond the paper: tables and walls, which confirm no pose.
  scene.planes = clock.book(&Times::verification, planesOf(scene.surface, settings_));
  // Section 3.1, a grid of keypoints; section 4, those of highest Gaussian curvature K = kappa_1 kappa_2.
  auto [keypoints, detected] = clock.book(
      &Times::keypoints, selectedKeypoints(scene.surface, *stages_.keypoints, settings_, scene.planes, largest_plane));
  scene.keypoints = keypointsOutside(occupied, std::move(keypoints));
  scene.occupied = occupied;
  // Beyond the paper: fewer of them where the sensor measures little.
  if (thinsByRange(settings_)) {
    scene.keypoints =
        clock.book(&Times::keypoints, thinnedByRange(scene.keypoints, scene.surface, settings_.surface.normal_radius));
  }
  // Section 3.1, descriptors with their local reference frames R_s.
  scene.descriptors =
      clock.book(&Times::descriptors, described(*stages_.descriptors, scene.surface, scene.keypoints, settings_));
  // Section 3.2, the nearest codewords under chi squared; beyond the paper: words of the background compete.
  scene.matches = clock.book(
      &Times::matching, matcher_->match(scene.descriptors.values, ambiguityOf(settings_), threads, background_.get()));
  // Eq. 1, R = R_s^T R_t, and eq. 2, votes for the centre: one Hough space for each object.
  scene.votes = clock.book(&Times::voting, castVotes(*codebook_, scene.matches, scene.descriptors, scene.keypoints));
  // Eq. 3, mean shift maxima of their density, and RANSAC; none where each vote is verified as a pose.
  std::vector<Hypothesis> hypotheses = clock.book(&Times::voting, verifier().propose(scene, *codebook_, settings_));
  // Beyond the paper: poses that the surface of the scene confirms.
  hypotheses = clock.book(&Times::verification, verifier().verify(std::move(hypotheses), scene, *codebook_, settings_));

  DetectionResult result;
  result.detections = clock.book(&Times::verification, ranked(hypotheses, *codebook_, verifier(), settings_));
  result.counts = countsOf(cloud, scene, detected);
  result.counts.hypotheses = result.detections.size();
  if (inspection) *inspection = inspectionOf(scene);
  result.times = clock.times();
  return result;
}

}  // namespace sks
