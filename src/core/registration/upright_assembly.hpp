// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/upright_alignment.hpp"
#include "core/registration/upright_pair.hpp"

namespace sks {

/// Views on known planes, all put together at once: at the turns that agree best (assignedTurns()), and then moved view
/// by view to where all others say most for it. All get a pose, right or not. Deterministic for any number of threads.
/// @param pairs of all views that are to be put together; others get no pose
/// @return z along the normals of the planes, which lie in z = 0
ViewPoses assembledUpright(const std::vector<CapturedView>& views, const std::vector<UprightPair>& pairs,
                           const VerificationSettings& settings);

}  // namespace sks
