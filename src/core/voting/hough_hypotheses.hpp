// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/voting/maxima.hpp"

namespace sks {

/// RANSAC on the pairs {p_t, p_s} of a maximum's votes (section 3.2); then density, least-squares pose and box from
/// the inliers. Pairs are compared within one model frame: that of a training view, or of all views that are
/// registered to each other. The frame with most inliers gives the pose. Votes of frames with fewer than three pairs
/// can be neither confirmed nor contradicted: they stay. The evidence is the geometric mean of the densities of all
/// inliers and of those of the frame that gives the pose.
/// @return false if fewer than min_inliers agree
bool estimateHypothesis(const Codebook& codebook, std::uint32_t object, const std::vector<Vote>& votes,
                        const Maximum& maximum, const Settings& settings, Hypothesis& hypothesis);

/// The maxima that pass RANSAC (section 3.2).
std::vector<Hypothesis> houghHypotheses(const Codebook& codebook, const std::vector<std::vector<Vote>>& spaces,
                                        const std::vector<ObjectMaximum>& maxima, const Settings& settings);

}  // namespace sks
