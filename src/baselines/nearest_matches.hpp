// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/matching.hpp>

namespace sks::baselines {

/// Matches each descriptor with its nearest codeword. May be called from several threads.
MatchFunction nearestMatches(const Codebook& codebook);

}  // namespace sks::baselines
