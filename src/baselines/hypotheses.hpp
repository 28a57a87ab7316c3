// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/surface.hpp>

#include "baselines/grouping.hpp"

namespace sks::baselines {

// What supports a hypothesis, and what its score grows with, is its density: its inliers, as far as verification
// confirms them.

/// Removes hypotheses, refines and rates those that it leaves.
using HypothesisCheck = std::function<std::vector<Hypothesis>(std::vector<Hypothesis>, const Surface& scene)>;

/// The groups of all models, those with most inliers first; ties in order of the models. Inliers are indices of
/// matches, which are in the order of the descriptors.
std::vector<Hypothesis> groupedHypotheses(const Codebook& codebook, const FramedModels& models,
                                          const SceneDescription& scene, const Grouping& grouping, int threads);

/// Of those for one object that lie nearer to each other than `distance` the best rated. @return best first
std::vector<Hypothesis> withoutDuplicates(std::vector<Hypothesis> hypotheses, double distance);

/// ICP and PCL's global hypothesis verification.
HypothesisCheck globalVerification(const std::shared_ptr<const Codebook>& codebook, const AldomaSettings& settings,
                                   const RefinementSettings& refinement, int threads);

/// ICP and validation, twice.
HypothesisCheck doubleValidation(std::shared_ptr<const Codebook> codebook, const ZhouSettings& settings,
                                 const RefinementSettings& refinement, int threads);

}  // namespace sks::baselines
