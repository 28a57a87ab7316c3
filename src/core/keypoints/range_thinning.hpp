// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Fewer keypoints where the sensor samples the scene less densely than normals need: the fraction that keeps the
/// number of measurements for each keypoint constant. A grid has as many keypoints on a square metre of a far wall as
/// on one of the table before it, but what lies far away is measured with few noisy points. Those kept are spread
/// evenly.
/// @param normal_radius [m]
Keypoints thinnedByRange(const Keypoints& keypoints, const Surface& scene, double normal_radius);

}  // namespace sks
