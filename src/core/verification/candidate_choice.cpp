// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/candidate_choice.hpp"

#include <algorithm>
#include <numeric>

#include "core/verification/projective_refinement.hpp"
#include "core/verification/rough_support.hpp"

namespace sks {
namespace {

constexpr double first_rounds = 0.42;  // of all
constexpr double kept_share = 0.8;     // on recorded scenes the first right one was among the 15 best of 120
constexpr int kept_anyway = 6;         // one in so many, whatever its evidence
// Of the evidence that scores 0.5. With the wide tolerances of a quick look right poses have several times as much, but
// for objects of which next to nothing is in sight: these need the first ones of their object whatever their evidence.
constexpr double least_evidence = 0.75;

}  // namespace

std::vector<PoseCandidate> mostPromisingCandidates(std::vector<PoseCandidate> candidates, const PoseExaminer& examiner,
                                                   const VerifiedModels& models, const SceneView& scene,
                                                   const Settings& settings, int of_each, int threads) {
  const int rounds = int(first_rounds * settings.refinement.iterations);
  const double least = least_evidence * settings.verification.half_evidence;
  std::vector<double> evidence(candidates.size());
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    PoseCandidate& candidate = candidates[i];
    const RoughSurface& surface = models.rough[candidate.view];
    const Eigen::Isometry3d T =
        refineAlongRays(surface.sample, scene, settings.refinement, rounds, candidate.T_scene_model);
    const RoughSupport support = roughSupport(surface, scene, T);
    candidate.pre_score = support.scoreWithoutVotes();
    evidence[i] = examiner.roughEvidence(candidate.object, candidate.view, candidate.stands, T, support);
  }
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return candidates[a].pre_score > candidates[b].pre_score; });
  const int fewest = std::max(1, of_each / kept_anyway);
  const int most = std::max(fewest, int(kept_share * of_each));
  std::vector<int> count(models.codebook->objects.size(), 0);
  std::vector<PoseCandidate> kept;
  for (const std::size_t i : order) {
    const int rank = count[candidates[i].object]++;
    if (rank < fewest || (rank < most && evidence[i] >= least)) kept.push_back(candidates[i]);
  }
  return kept;
}

}  // namespace sks
