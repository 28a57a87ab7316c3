// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulation/pixel_random.hpp"
#include "simulation/shapes.hpp"

namespace sks {

/// A random print as on packages: fields of few colours, with bands, discs and lines of text, another on each side.
/// @param size edge of the print [m]
Paint packagePrint(PixelRandom& random, float size);

/// A random pattern of a table, floor or wall: plain, planks, squares or speckles.
Paint groundPattern(PixelRandom& random);

}  // namespace sks
