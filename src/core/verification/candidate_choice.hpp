// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/settings.hpp>

#include "core/verification/pose_candidates.hpp"
#include "core/verification/pose_examiner.hpp"

namespace sks {

/// Of each object the candidates that fit the scene best after some rounds of ICP with few points, at most four fifths
/// of `of_each`, and of these beyond the first sixth only those whose rough evidence is not hopelessly small: by then
/// right ones stand out. Best first; their poses are as they were. The same for any number of threads.
std::vector<PoseCandidate> mostPromisingCandidates(std::vector<PoseCandidate> candidates, const PoseExaminer& examiner,
                                                   const VerifiedModels& models, const SceneView& scene,
                                                   const Settings& settings, int of_each, int threads);

}  // namespace sks
