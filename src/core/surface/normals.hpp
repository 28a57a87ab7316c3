// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Estimates and orients the normal at every point. Deterministic for any number of threads.
void estimateNormals(Surface& surface, const SurfaceSettings& settings, Orientation orientation, int threads);

/// Normals of an organised cloud by windows of its image, turned towards the sensor; what `surface` was made from.
/// @return false, and nothing is changed, where the cloud is no image of a pinhole camera
bool takeImageNormals(Surface& surface, const Cloud& sanitized, const SurfaceSettings& settings, int threads);

}  // namespace sks
