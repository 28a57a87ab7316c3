// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/hough_verifier.hpp"

#include "core/verification/refinement.hpp"
#include "core/verification/score.hpp"

namespace sks {

HoughVerifier::HoughVerifier(const Codebook& codebook) : words_of_view_(codebook.views.size(), 0) {
  for (const Codeword& word : codebook.words) ++words_of_view_[word.view];
}

std::vector<Hypothesis> HoughVerifier::verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                              const Codebook& codebook, const Settings& settings) const {
  if (settings.refinement.iterations > 0) {
    refineHypotheses(proposed, codebook, scene.surface, settings.refinement, threadCount(settings));
  }
  return proposed;
}

double HoughVerifier::score(const Hypothesis& hypothesis, const Settings& settings) const {
  return scoreOfVotes(hypothesis, words_of_view_.at(hypothesis.view), settings);
}

}  // namespace sks
