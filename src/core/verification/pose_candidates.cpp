// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "core/voting/vote_density.hpp"

namespace sks {
namespace {

constexpr int fewest_share = 4;         // one in so many of `verification.candidates` is looked at in any case
constexpr int most_at_a_position = 24;  // candidates of one object whose box centres are near each other
constexpr int most_of_a_view = 3;       // of these
constexpr int fewest_supported = 6;     // points, as many as a rigid motion has degrees of freedom
constexpr double prior_weight = 0.2;    // keeps the fraction of a very small weight low

Eigen::Isometry3d poseOf(const Vote& vote, const Codeword& word) {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  T_scene_model.linear() = Eigen::Quaterniond(vote.rotation.cast<double>()).normalized().toRotationMatrix();
  T_scene_model.translation() = vote.keypoint.cast<double>() - T_scene_model.linear() * word.position.cast<double>();
  return T_scene_model;
}

/// The best ones, spread over the positions that votes point to: a strong instance leaves room for others of its
/// object.
std::vector<PoseCandidate> mostPromising(std::vector<PoseCandidate> candidates, int most, const Codebook& codebook,
                                         const Settings& settings) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.pre_score > b.pre_score; });
  const double radius = settings.voting.suppression_radius;
  std::vector<PoseCandidate> kept;
  std::vector<std::pair<Eigen::Vector3d, std::uint32_t>> positions;  // and views
  for (const PoseCandidate& candidate : candidates) {
    if (candidate.pre_score <= 0 || int(kept.size()) >= most) break;
    const Eigen::Vector3d position = candidate.T_scene_model * codebook.views[candidate.view].center().cast<double>();
    int near = 0, of_view = 0;
    for (const auto& [other, view] : positions) {
      if ((position - other).norm() >= radius) continue;
      ++near;
      of_view += view == candidate.view;
    }
    if (near >= most_at_a_position || of_view >= most_of_a_view) continue;
    kept.push_back(candidate);
    positions.emplace_back(position, candidate.view);
  }
  return kept;
}

}  // namespace

int candidatesOfEach(const std::vector<std::vector<Vote>>& spaces, const VerificationSettings& settings) {
  const auto voted = std::count_if(spaces.begin(), spaces.end(), [](const auto& votes) { return !votes.empty(); });
  const int share = settings.total_candidates / std::max(1, int(voted));
  return std::min(settings.candidates, std::max({1, settings.candidates / fewest_share, share}));
}

std::vector<PoseCandidate> poseCandidates(const Codebook& codebook, const std::vector<RoughSurface>& surfaces,
                                          const std::vector<std::vector<Vote>>& spaces, const SceneView& scene,
                                          const Settings& settings, int of_each, int threads) {
  std::vector<PoseCandidate> all;
  for (std::uint32_t object = 0; object < spaces.size(); ++object) {
    const std::vector<Vote>& votes = spaces[object];
    if (votes.empty()) continue;  // of thousands of objects, most
    const VoteDensity density(votes, settings.voting.bandwidth);
    std::vector<PoseCandidate> candidates(votes.size());
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const Codeword& word = codebook.words[votes[i].word];
      PoseCandidate& candidate = candidates[i];
      candidate = {object, word.view, poseOf(votes[i], word), 0, false};
      const RoughSupport support = roughSupport(surfaces[word.view], scene, candidate.T_scene_model);
      if (support.points < fewest_supported) continue;
      const double fraction = support.supported / (support.visible + prior_weight);
      candidate.pre_score = fraction * std::sqrt(support.supported * density.at(votes[i].position));
    }
    const std::vector<PoseCandidate> best = mostPromising(std::move(candidates), of_each, codebook, settings);
    all.insert(all.end(), best.begin(), best.end());
  }
  return all;
}

}  // namespace sks
