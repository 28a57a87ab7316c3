// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/verification/pose_candidates.hpp"
#include "core/verification/pose_examiner.hpp"
#include "core/verification/standing_things.hpp"

namespace sks {

/// Poses without a vote: what stands alone on a plane, compared with each object that is as high and as wide in one of
/// its resting poses. Small, flat and thin objects have too few keypoints, and these see more of the table than of the
/// object. Only objects that are known from all sides have some. For each thing, object and resting pose the best
/// rotation about the upright axis.
std::vector<PoseCandidate> standingCandidates(const VerifiedModels& models, const std::vector<StandingThing>& things,
                                              const SceneView& scene, int threads);

}  // namespace sks
