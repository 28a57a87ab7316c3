// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/verification/pile_parts.hpp"
#include "core/verification/pose_candidates.hpp"
#include "core/verification/pose_examiner.hpp"

namespace sks {

/// Poses without a vote, in piles: a plane face of the pile may be the top of an object that lies there in one of its
/// resting poses, a stick may be one. Each part is compared with each object that it may be a part of, or that may be a
/// part of it, about the middle of the part and at its ends and corners. The best few poses for each part.
/// Deterministic, for any number of threads.
std::vector<PoseCandidate> pileCandidates(const VerifiedModels& models, const std::vector<PilePart>& parts,
                                          const SceneView& scene, int threads);

}  // namespace sks
