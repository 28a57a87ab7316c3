// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Median angle between neighbouring points of a scene as its sensor sees them [rad].
/// @param radius within which most points have a neighbour [m]; points without one count as that far apart
float angularSpacing(const Surface& scene, float radius);

/// The same of all that the sensor measured, where prepareScene() kept only some of it.
float sensorSpacing(const Surface& scene, float radius);

/// How well a sensor samples a surface at a range, at most 1: measurements within the radius of a normal, beside the
/// four spacings that are enough. The number of measurements on an area falls with the square of the range.
/// @param spacing between measurements [rad], of sensorSpacing()
double samplingAt(double range, double spacing, double normal_radius);

}  // namespace sks
