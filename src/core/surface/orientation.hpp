// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Turns the normals of a closed model outwards: towards where each point can be seen from, over directions spread
/// evenly around the model. Points that are occluded from everywhere follow their neighbours.
void orientOutward(Surface& surface, int threads);

}  // namespace sks
