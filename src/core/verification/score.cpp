// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/score.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr double score_steepness = 8;  // of the logistic function, fitted to simulated clutter (docs/accuracy.md)

// A view of n codewords is found with about n^0.6 votes (docs/method.md): `detection.half_density` is that of 270.
constexpr double usual_words = 270, words_power = 0.6;

}  // namespace

double scoreOfDensity(const Hypothesis& hypothesis, const Settings& settings) {
  return hypothesis.density / (hypothesis.density + settings.detection.half_density);
}

double scoreOfVotes(const Hypothesis& hypothesis, std::size_t words, const Settings& settings) {
  const double size = double(std::max<std::size_t>(words, 1)) / usual_words;
  return hypothesis.evidence / (hypothesis.evidence + settings.detection.half_density * std::pow(size, words_power));
}

double scoreOfEvidence(const Hypothesis& hypothesis, const Settings& settings) {
  const double power = std::pow(hypothesis.evidence / settings.verification.half_evidence, score_steepness);
  return power / (power + 1);
}

}  // namespace sks
