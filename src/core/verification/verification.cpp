// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/verification.hpp"

#include <algorithm>
#include <tuple>

#include "core/verification/candidate_choice.hpp"
#include "core/verification/color_shift.hpp"
#include "core/verification/pile_candidates.hpp"
#include "core/verification/pose_candidates.hpp"
#include "core/verification/projective_refinement.hpp"
#include "core/verification/score.hpp"
#include "core/verification/standing_candidates.hpp"

namespace sks {
namespace {

constexpr double largest_claimed = 0.5;  // of the confirming points; else a hypothesis claims none itself
// Of the evidence that scores 0.5: what has less is not worth the last rounds, or a search for more than what is in
// sight.
constexpr double plausible_fraction = 0.5, lowest_fraction = 0.3;
constexpr int most_examined = 4;  // hypotheses of one object at one position, with all they have

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

/// Of the boxes of all objects [m].
float largestDiagonal(const Codebook& codebook) {
  float largest = 0;
  for (const TrainingView& view : codebook.views) largest = std::max(largest, view.extent().norm());
  return largest;
}

/// The poses whose box has its centre in none of the occupied ones.
std::vector<PoseCandidate> candidatesOutside(const std::vector<OccupiedBox>& occupied,
                                             std::vector<PoseCandidate> candidates, const Codebook& codebook) {
  if (occupied.empty()) return candidates;
  const auto inside = [&](const PoseCandidate& candidate) {
    const Eigen::Vector3d center = candidate.T_scene_model * codebook.views[candidate.view].center().cast<double>();
    return std::any_of(occupied.begin(), occupied.end(), [&](const auto& box) { return box.contains(center); });
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), inside), candidates.end());
  return candidates;
}

bool better(const Examined& a, const Examined& b) {
  const auto key = [](const Hypothesis& h) {
    const Eigen::Vector3d p = h.T_scene_box.translation();
    return std::make_tuple(-h.evidence, h.object, p.x(), p.y(), p.z());
  };
  return key(a.hypothesis) < key(b.hypothesis);
}

/// Of hypotheses for one object at one position the `most` best; `examined` is sorted.
std::vector<Examined> bestAtPositions(std::vector<Examined> examined, int most, const Settings& settings) {
  std::vector<Examined> kept;
  for (Examined& candidate : examined) {
    const Hypothesis& a = candidate.hypothesis;
    const auto better_ones = std::count_if(kept.begin(), kept.end(), [&](const Examined& other) {
      const Hypothesis& b = other.hypothesis;
      const double distance = (a.T_scene_box.translation() - b.T_scene_box.translation()).norm();
      return a.object == b.object && distance < settings.voting.suppression_radius;
    });
    if (better_ones < most) kept.push_back(std::move(candidate));
  }
  return kept;
}

/// The best hypotheses of each object; `examined` is sorted.
std::vector<Examined> bestOfObjects(std::vector<Examined> examined, const Codebook& codebook,
                                    const Settings& settings) {
  std::vector<Examined> kept;
  std::vector<int> count(codebook.objects.size(), 0);
  for (Examined& candidate : examined) {
    if (count[candidate.hypothesis.object]++ < settings.detection.max_per_object) kept.push_back(std::move(candidate));
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

std::vector<Hypothesis> SurfaceVerifier::propose(const SceneDescription& /*scene*/, const Codebook& /*codebook*/,
                                                 const Settings& /*settings*/) const {
  return {};
}

std::vector<Hypothesis> SurfaceVerifier::verify(std::vector<Hypothesis> /*proposed*/, const SceneDescription& scene,
                                                const Codebook& /*codebook*/, const Settings& settings) const {
  const int threads = threadCount(settings);
  return findPoses(scene, SceneView(scene.surface, scene.planes, settings, threads), settings, threads);
}

double SurfaceVerifier::score(const Hypothesis& hypothesis, const Settings& settings) const {
  return scoreOfEvidence(hypothesis, settings);
}

std::vector<Hypothesis> SurfaceVerifier::findPoses(const SceneDescription& description, SceneView scene,
                                                   const Settings& settings, int threads) const {
  const VerifiedModels& models = *models_;
  const Codebook& codebook = *models.codebook;
  const std::vector<std::vector<Vote>>& spaces = description.votes;
  const int of_each = candidatesOfEach(spaces, settings.verification);
  std::vector<PoseCandidate> candidates =
      poseCandidates(codebook, models.rough, spaces, scene, settings, of_each, threads);
  if (!models.resting.empty()) {
    StandingThings standing =
        findStandingThings(scene.surface, scene.planes, largestDiagonal(codebook), models.stickWidth(), threads);
    scene.rises = std::move(standing.rises);
    for (const auto& more : {standingCandidates(models, standing.things, scene, threads),
                             pileCandidates(models, standing.parts, scene, threads)}) {
      candidates.insert(candidates.end(), more.begin(), more.end());
    }
  }
  candidates = candidatesOutside(description.occupied, std::move(candidates), codebook);
  const PoseExaminer examiner(models, scene, spaces, settings);
  candidates = mostPromisingCandidates(std::move(candidates), examiner, models, scene, settings, of_each, threads);
  const double half = settings.verification.half_evidence;

  std::vector<Examined> examined(candidates.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const PoseCandidate& candidate = candidates[i];
    Hypothesis hypothesis;
    hypothesis.object = candidate.object;
    hypothesis.view = candidate.view;
    hypothesis.stands = candidate.stands;
    hypothesis.T_scene_model =
        refineAlongRays(codebook.views[candidate.view], scene, settings.refinement, candidate.T_scene_model);
    examined[i] = examiner.examineAlongRays(std::move(hypothesis));
  }
  std::sort(examined.begin(), examined.end(), better);
  examined = bestAtPositions(std::move(examined), most_examined, settings);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < examined.size(); ++i) {
    if (examined[i].hypothesis.evidence < lowest_fraction * half) continue;
    examined[i] = examiner.examineRoughly(std::move(examined[i].hypothesis));
  }
  std::sort(examined.begin(), examined.end(), better);
  examined = bestOfObjects(bestAtPositions(std::move(examined), 1, settings), codebook, settings);

  const auto isPlausible = [&](const Examined& e) { return e.hypothesis.evidence >= plausible_fraction * half; };
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < examined.size(); ++i) {
    if (!isPlausible(examined[i])) continue;
    examined[i] = examiner.examine(examiner.refined(std::move(examined[i].hypothesis)));
  }
  scene.color_shift = sceneColorShift(examined, color_doubt * half);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < examined.size(); ++i) {
    if (!isPlausible(examined[i]) || !scene.comparesColor(codebook.views[examined[i].hypothesis.view])) continue;
    examined[i] = examiner.examine(examiner.bestTurned(examined[i].hypothesis));
  }
  std::sort(examined.begin(), examined.end(), better);
  resolveConflicts(examined, scene.surface, float(settings.verification.support_distance));
  std::sort(examined.begin(), examined.end(), better);

#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t i = 0; i < examined.size(); ++i) {
    if (isPlausible(examined[i])) examined[i].hypothesis = examiner.finished(examined[i].hypothesis);
  }

  std::vector<Hypothesis> hypotheses;
  for (Examined& candidate : examined) {
    Hypothesis& hypothesis = candidate.hypothesis;
    hypothesis.inliers = inliersOf(codebook, spaces[hypothesis.object], hypothesis, settings);
    hypotheses.push_back(std::move(hypothesis));
  }
  return hypotheses;
}

}  // namespace sks
