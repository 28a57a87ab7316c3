// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/verification.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/verification/pose_candidates.hpp"
#include "core/verification/projective_refinement.hpp"
#include "core/verification/refinement.hpp"
#include "core/verification/score.hpp"
#include "core/voting/vote_density.hpp"

namespace sks {
namespace {

constexpr double area_unit = 1e-4;       // [m^2] areas enter the evidence in cm^2
constexpr double prior_area = 0.25e-4;   // [m^2] keeps the fraction of a very small area low
constexpr double color_gain = 1.7;       // of evidence: agreement in colour is worth three times the area
constexpr double largest_claimed = 0.5;  // of the confirming points; else a hypothesis claims none itself

constexpr std::size_t first_points = 250, last_points = 1500;  // of a surface, examined before and after the choice
// Of the evidence that scores 0.5: what has less is not worth the last rounds, or a search for more than what is in
// sight.
constexpr double plausible_fraction = 0.5, lowest_fraction = 0.15;

/// Of ICP with nearest pairs, for poses that are a fraction of a millimetre off.
RefinementSettings lastRounds(RefinementSettings settings) {
  settings.iterations = (settings.iterations + 1) / 2;
  settings.start_distance = settings.end_distance;
  return settings;
}

/// A hypothesis and the part of the scene that it explains.
struct Examined {
  Hypothesis hypothesis;
  std::vector<std::uint32_t> confirming;
};

/// Of the density that votes have after this selection, what they would have after that of half the keypoints, for
/// which the evidence that scores 0.5 is set.
double densityAsOfHalf(double density, const KeypointSettings& keypoints) {
  const bool ranks = keypoints.detector == KeypointDetector::grid && keypoints.selection == SelectionRule::rank;
  return ranks ? density * 0.5 / (1 - keypoints.discard) : density;
}

/// The evidence grows with the fraction of the visible surface that is confirmed, with its weighted area, with the
/// fraction of all that faces the sensor, and with the votes for the position.
double evidenceOf(const PoseEvidence& pose, double density) {
  const double fraction = pose.weighted_supported / (pose.weighted_visible + prior_area);
  const double coverage = pose.supported / (pose.facing + prior_area);
  return fraction * std::sqrt(pose.weighted_supported / area_unit * coverage) * std::cbrt(density);
}

/// Votes for the position of the hypothesis whose correspondences fit its pose.
std::vector<std::uint32_t> inliersOf(const Codebook& codebook, const std::vector<Vote>& votes,
                                     const Hypothesis& hypothesis, const Settings& settings) {
  const Eigen::Vector3f center = hypothesis.T_scene_box.translation().cast<float>();
  const std::string& frame = codebook.views[hypothesis.view].frameName();
  std::vector<std::uint32_t> inliers;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const Codeword& word = codebook.words[votes[i].word];
    if (word.view != hypothesis.view && codebook.views[word.view].frameName() != frame) continue;
    const Eigen::Vector3d mapped = hypothesis.T_scene_model * word.position.cast<double>();
    const bool here = (votes[i].position - center).norm() <= settings.voting.bandwidth;
    const bool fits = (mapped - votes[i].keypoint.cast<double>()).norm() <= settings.ransac.inlier_threshold;
    if (here && fits) inliers.push_back(std::uint32_t(i));
  }
  return inliers;
}

bool better(const Examined& a, const Examined& b) {
  const auto key = [](const Hypothesis& h) {
    const Eigen::Vector3d p = h.T_scene_box.translation();
    return std::make_tuple(-h.evidence, h.object, p.x(), p.y(), p.z());
  };
  return key(a.hypothesis) < key(b.hypothesis);
}

/// Of hypotheses for one object at one position the best; `examined` is sorted.
std::vector<Examined> suppressNonMaxima(std::vector<Examined> examined, const Codebook& codebook,
                                        const Settings& settings) {
  std::vector<Examined> kept;
  std::vector<int> count(codebook.objects.size(), 0);
  for (Examined& candidate : examined) {
    const Hypothesis& a = candidate.hypothesis;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Examined& other) {
      const Hypothesis& b = other.hypothesis;
      const double distance = (a.T_scene_box.translation() - b.T_scene_box.translation()).norm();
      return a.object == b.object && distance < settings.voting.suppression_radius;
    });
    if (known || count[a.object] >= settings.detection.max_per_object) continue;
    ++count[a.object];
    kept.push_back(std::move(candidate));
  }
  return kept;
}

/// Each scene point belongs to the best hypothesis that explains it: the others lose their evidence by that fraction.
void resolveConflicts(std::vector<Examined>& examined, const Surface& scene, float distance) {
  std::vector<char> claimed(scene.size(), 0);
  std::vector<PointGrid::Run> runs;
  for (Examined& candidate : examined) {
    const auto& confirming = candidate.confirming;
    if (confirming.empty()) continue;
    const auto taken = std::count_if(confirming.begin(), confirming.end(), [&](std::uint32_t i) { return claimed[i]; });
    const double fraction = double(taken) / double(confirming.size());
    candidate.hypothesis.evidence *= 1 - fraction;
    if (fraction >= largest_claimed) continue;
    for (const std::uint32_t i : confirming) {
      scene.forEachNeighbor(scene.point(i), distance, runs, [&](std::uint32_t j, float) { claimed[j] = 1; });
    }
  }
}

}  // namespace

SurfaceVerifier::SurfaceVerifier(std::shared_ptr<const Codebook> codebook) : codebook_(std::move(codebook)) {
  weights_.reserve(codebook_->views.size());
  for (const TrainingView& view : codebook_->views) weights_.emplace_back(view);
}

std::vector<Hypothesis> SurfaceVerifier::propose(const SceneDescription& /*scene*/, const Codebook& /*codebook*/,
                                                 const Settings& /*settings*/) const {
  return {};
}

std::vector<Hypothesis> SurfaceVerifier::verify(std::vector<Hypothesis> /*proposed*/, const SceneDescription& scene,
                                                const Codebook& /*codebook*/, const Settings& settings) const {
  const int threads = threadCount(settings);
  return findPoses(scene.votes, SceneView(scene.surface, scene.planes, settings, threads), settings, threads);
}

double SurfaceVerifier::score(const Hypothesis& hypothesis, const Settings& settings) const {
  return scoreOfEvidence(hypothesis, settings);
}

std::vector<Hypothesis> SurfaceVerifier::findPoses(const std::vector<std::vector<Vote>>& spaces, const SceneView& scene,
                                                   const Settings& settings, int threads) const {
  const std::vector<PoseCandidate> candidates = poseCandidates(*codebook_, weights_, spaces, scene, settings, threads);
  std::vector<std::optional<VoteDensity>> densities(spaces.size());
  for (const PoseCandidate& candidate : candidates) {
    if (!densities[candidate.object]) {
      densities[candidate.object].emplace(spaces[candidate.object], settings.voting.bandwidth);
    }
  }
  const auto examine = [&](Hypothesis hypothesis, std::size_t most_points, CorrespondenceSearch search) {
    const TrainingView& view = codebook_->views[hypothesis.view];
    hypothesis.T_scene_box = hypothesis.T_scene_model * Eigen::Translation3d(view.center().cast<double>());
    hypothesis.box_size = view.extent().cast<double>();
    const Eigen::Vector3f center = hypothesis.T_scene_box.translation().cast<float>();
    hypothesis.density = densities[hypothesis.object]->at(center);
    hypothesis.votes = densities[hypothesis.object]->count(center);
    PoseEvidence evidence =
        examinePose(view, weights_[hypothesis.view], scene, settings, hypothesis.T_scene_model, most_points, search);
    hypothesis.evidence = evidenceOf(evidence, densityAsOfHalf(hypothesis.density, settings.keypoints));
    if (scene.comparesColor(view)) hypothesis.evidence *= color_gain;
    return Examined{std::move(hypothesis), std::move(evidence.confirming)};
  };

  const double plausible = plausible_fraction * settings.verification.half_evidence;
  const double lowest_evidence = lowest_fraction * settings.verification.half_evidence;
  std::vector<Examined> examined(candidates.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const PoseCandidate& candidate = candidates[i];
    Hypothesis hypothesis;
    hypothesis.object = candidate.object;
    hypothesis.view = candidate.view;
    hypothesis.T_scene_model =
        refineAlongRays(codebook_->views[candidate.view], scene, settings.refinement, candidate.T_scene_model);
    examined[i] = examine(hypothesis, first_points, CorrespondenceSearch::along_ray);
    if (examined[i].hypothesis.evidence < lowest_evidence) continue;
    examined[i] = examine(std::move(hypothesis), first_points, CorrespondenceSearch::nearby);
  }
  std::sort(examined.begin(), examined.end(), better);
  examined = suppressNonMaxima(std::move(examined), *codebook_, settings);

#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < examined.size(); ++i) {
    Hypothesis hypothesis = examined[i].hypothesis;
    if (hypothesis.evidence < plausible) continue;
    const TrainingView& view = codebook_->views[hypothesis.view];
    hypothesis.T_scene_model = refinePose(view.surface_points, view.surface_normals, scene.surface,
                                          lastRounds(settings.refinement), hypothesis.T_scene_model);
    examined[i] = examine(std::move(hypothesis), last_points, CorrespondenceSearch::nearby);
  }
  std::sort(examined.begin(), examined.end(), better);
  resolveConflicts(examined, scene.surface, float(settings.verification.support_distance));
  std::sort(examined.begin(), examined.end(), better);

  std::vector<Hypothesis> hypotheses;
  for (Examined& candidate : examined) {
    Hypothesis& hypothesis = candidate.hypothesis;
    hypothesis.inliers = inliersOf(*codebook_, spaces[hypothesis.object], hypothesis, settings);
    hypotheses.push_back(std::move(hypothesis));
  }
  return hypotheses;
}

}  // namespace sks
