// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/hough_verifier.hpp"

#include "core/verification/refinement.hpp"

namespace sks {

std::vector<Hypothesis> HoughVerifier::verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                              const Codebook& codebook, const Settings& settings) const {
  if (settings.refinement.iterations > 0) {
    refineHypotheses(proposed, codebook, scene.surface, settings.refinement, threadCount(settings));
  }
  return proposed;
}

}  // namespace sks
