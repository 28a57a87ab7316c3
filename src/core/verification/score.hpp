// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>

namespace sks {

/// Confidence in [0, 1) by the density of the inliers' votes, 0.5 at `detection.half_density`; comparable across
/// scenes.
double scoreOfDensity(const Hypothesis& hypothesis, const Settings& settings);

/// Confidence in [0, 1) by the evidence of the votes (section 3.2), as a share of what its training view offers: 0.5 at
/// `detection.half_density` for a view of 270 codewords, at less for smaller ones. It means the same for each object,
/// sensor and size of codebook.
/// @param words codewords of the hypothesis' view
double scoreOfVotes(const Hypothesis& hypothesis, std::size_t words, const Settings& settings);

/// Confidence in [0, 1) of a pose that was verified: logistic in the logarithm of its evidence, 0.5 at
/// `verification.half_evidence`; comparable across scenes.
double scoreOfEvidence(const Hypothesis& hypothesis, const Settings& settings);

}  // namespace sks
