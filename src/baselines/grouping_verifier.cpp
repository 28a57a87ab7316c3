// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/grouping_verifier.hpp"

#include <utility>

namespace sks::baselines {

GroupingVerifier::GroupingVerifier(const Codebook& codebook, Grouping grouping, HypothesisCheck check,
                                   double half_support)
    : models_(codebook), grouping_(std::move(grouping)), check_(std::move(check)), half_support_(half_support) {}

std::vector<Hypothesis> GroupingVerifier::propose(const SceneDescription& scene, const Codebook& codebook,
                                                  const Settings& settings) const {
  return groupedHypotheses(codebook, models_, scene, grouping_, threadCount(settings));
}

std::vector<Hypothesis> GroupingVerifier::verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                                 const Codebook& /*codebook*/, const Settings& settings) const {
  if (check_) proposed = check_(std::move(proposed), scene.surface);
  return withoutDuplicates(std::move(proposed), settings.voting.suppression_radius);
}

double GroupingVerifier::score(const Hypothesis& hypothesis, const Settings& /*settings*/) const {
  return hypothesis.density / (hypothesis.density + half_support_);
}

}  // namespace sks::baselines
