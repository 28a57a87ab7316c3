// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/descriptors/neighborhood.hpp"
#include "core/descriptors/shot_support.hpp"

namespace sks {

/// Writes SHOT's 32 histograms of the angle between the neighbours' normals and the z axis to `histogram` (352 bins).
/// SIMD, runtime dispatch.
void shapeHistogram(const Neighborhood& neighborhood, const ShotSupport& support, float* histogram);

/// Writes CSHOT's 32 histograms of the CIELab distance to the keypoint's colour to `histogram` (992 bins). The colour
/// of a keypoint, a centroid, is the mean of the neighbours within `core_radius`, or that of the nearest.
void colorHistogram(const Surface& surface, const Neighborhood& neighborhood, const ShotSupport& support,
                    float core_radius, float* histogram);

/// Scales to unit L2 norm; false if all bins are 0.
bool normalize(float* histogram, std::size_t size);

}  // namespace sks
