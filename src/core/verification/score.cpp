// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/score.hpp"

#include <cmath>

namespace sks {
namespace {

constexpr double steepness = 8;  // of the logistic function, fitted to simulated clutter (docs/accuracy.md)

}  // namespace

double scoreOfDensity(const Hypothesis& hypothesis, const Settings& settings) {
  return hypothesis.density / (hypothesis.density + settings.detection.half_density);
}

double scoreOfEvidence(const Hypothesis& hypothesis, const Settings& settings) {
  const double power = std::pow(hypothesis.evidence / settings.verification.half_evidence, steepness);
  return power / (power + 1);
}

}  // namespace sks
