// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>

namespace sks {

/// Confidence in [0, 1) of a hypothesis, comparable across scenes. Where poses are verified: logistic in the logarithm
/// of the evidence, 0.5 at `verification.half_evidence`. Else it grows with the density of its inliers' votes and is
/// 0.5 at `detection.half_density`.
double score(const Hypothesis& hypothesis, const Settings& settings);

}  // namespace sks
