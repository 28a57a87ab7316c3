// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/candidate_choice.hpp"

#include <algorithm>

#include "core/verification/projective_refinement.hpp"
#include "core/verification/rough_support.hpp"

namespace sks {
namespace {

constexpr double first_rounds = 0.42;  // of all
constexpr double kept_share = 0.8;     // on recorded scenes the first right one was among the 15 best of 120
constexpr int fewest_kept = 20;        // of an object
// Of the evidence that scores 0.5. With the wide tolerances of a quick look right poses have more than this, nearly all
// of them several times as much.
constexpr double least_evidence = 0.75;

}  // namespace

std::vector<PoseCandidate> mostPromisingCandidates(std::vector<PoseCandidate> candidates, const PoseExaminer& examiner,
                                                   const VerifiedModels& models, const SceneView& scene,
                                                   const Settings& settings, int threads) {
  const int rounds = int(first_rounds * settings.refinement.iterations);
  const double least = least_evidence * settings.verification.half_evidence;
  std::vector<char> hopeless(candidates.size(), 0);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    PoseCandidate& candidate = candidates[i];
    const RoughSurface& surface = models.rough[candidate.view];
    const Eigen::Isometry3d T =
        refineAlongRays(surface.sample, scene, settings.refinement, rounds, candidate.T_scene_model);
    const RoughSupport support = roughSupport(surface, scene, T);
    candidate.pre_score = support.scoreWithoutVotes();
    hopeless[i] = examiner.roughEvidence(candidate.object, candidate.view, candidate.stands, T, support) < least;
  }
  std::vector<PoseCandidate> promising;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!hopeless[i]) promising.push_back(candidates[i]);
  }
  std::stable_sort(promising.begin(), promising.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.pre_score > b.pre_score; });
  const int most = std::max(fewest_kept, int(kept_share * settings.verification.candidates));
  std::vector<int> count(models.codebook->objects.size(), 0);
  std::vector<PoseCandidate> kept;
  for (const PoseCandidate& candidate : promising) {
    if (count[candidate.object]++ < most) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace sks
