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

}  // namespace

std::vector<PoseCandidate> mostPromisingCandidates(std::vector<PoseCandidate> candidates, const VerifiedModels& models,
                                                   const SceneView& scene, const Settings& settings, int threads) {
  const int rounds = int(first_rounds * settings.refinement.iterations);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const RoughSurface& surface = models.rough[candidates[i].view];
    const Eigen::Isometry3d T =
        refineAlongRays(surface.sample, scene, settings.refinement, rounds, candidates[i].T_scene_model);
    candidates[i].pre_score = roughSupport(surface, scene, T).scoreWithoutVotes();
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.pre_score > b.pre_score; });
  const int most = std::max(fewest_kept, int(kept_share * settings.verification.candidates));
  std::vector<int> count(models.codebook->objects.size(), 0);
  std::vector<PoseCandidate> kept;
  for (const PoseCandidate& candidate : candidates) {
    if (count[candidate.object]++ < most) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace sks
