// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

/// How many things there are that stand about everywhere and are no object in particular: boxes, cans, bottles, balls,
/// rods and the like in sizes from 2 to 25 cm. Always the same.
std::size_t backgroundThings();

/// Views of one of them, alone and on a table, each from two directions, without noise.
/// @return clouds without colour, in the frame of the camera
std::vector<Cloud> backgroundViews(std::size_t thing);

}  // namespace sks
