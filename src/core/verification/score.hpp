// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>

namespace sks {

/// Confidence in [0, 1) by the density of the inliers' votes, 0.5 at `detection.half_density`; comparable across
/// scenes.
double scoreOfDensity(const Hypothesis& hypothesis, const Settings& settings);

/// Confidence in [0, 1) of a pose that was verified: logistic in the logarithm of its evidence, 0.5 at
/// `verification.half_evidence`; comparable across scenes.
double scoreOfEvidence(const Hypothesis& hypothesis, const Settings& settings);

}  // namespace sks
