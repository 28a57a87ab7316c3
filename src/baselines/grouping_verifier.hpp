// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/stages/stages.hpp>

#include "baselines/hypotheses.hpp"

namespace sks::baselines {

/// Hypotheses of a baseline as a stage: a grouping of the matches, a check or none, and suppression of duplicates.
class GroupingVerifier : public VerifierStage {
public:
  /// @param codebook whose matches are grouped
  /// @param check may be empty
  /// @param half_support the support that scores 0.5: support / (support + half_support), whatever the scene
  GroupingVerifier(const Codebook& codebook, Grouping grouping, HypothesisCheck check, double half_support);

  std::vector<Hypothesis> propose(const SceneDescription& scene, const Codebook& codebook,
                                  const Settings& settings) const override;
  /// @return best first
  std::vector<Hypothesis> verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                 const Codebook& codebook, const Settings& settings) const override;
  double score(const Hypothesis& hypothesis, const Settings& settings) const override;

private:
  FramedModels models_;
  Grouping grouping_;
  HypothesisCheck check_;
  double half_support_;
};

}  // namespace sks::baselines
