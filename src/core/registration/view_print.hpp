// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/stages/surface.hpp>

namespace sks {

/// What is printed or painted on a surface, without the light that falls on it: the logarithms of the brightness over
/// that of the surroundings, of red over green, and of blue over green. White balance shifts the last two by the same
/// everywhere; exposure and shading move none. Averaged over some millimetres: cameras see colours up to two pixels
/// beside their depths.
/// @return one for each point; empty without colour
std::vector<Eigen::Vector3f> printsOf(const Surface& surface);

}  // namespace sks
