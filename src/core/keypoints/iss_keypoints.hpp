// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Intrinsic shape signatures (Zhong 2009) as PCL has them: neighbours without weights. Points of the surface, in its
/// order; the same for any number of threads.
Keypoints issKeypoints(const Surface& surface, const KeypointSettings& settings, int threads);

}  // namespace sks
