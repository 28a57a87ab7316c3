// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/stages.hpp>

#include "core/verification/score.hpp"
#include "core/voting/hough_hypotheses.hpp"
#include "core/voting/maxima.hpp"

namespace sks {

KeypointStage::~KeypointStage() = default;

Keypoints KeypointStage::select(const Surface& /*surface*/, Keypoints keypoints, const Settings& /*settings*/) const {
  return keypoints;
}

DescriptorStage::~DescriptorStage() = default;

VerifierStage::~VerifierStage() = default;

std::vector<Hypothesis> VerifierStage::propose(const SceneDescription& scene, const Codebook& codebook,
                                               const Settings& settings) const {
  const std::vector<ObjectMaximum> maxima = findAllMaxima(scene.votes, settings, threadCount(settings));
  return houghHypotheses(codebook, scene.votes, maxima, settings);
}

double VerifierStage::score(const Hypothesis& hypothesis, const Settings& settings) const {
  return scoreOfDensity(hypothesis, settings);
}

}  // namespace sks
