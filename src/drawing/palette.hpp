// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

/// Colours that are easily told apart and can be read on black as on white, one for each index; they repeat after
/// palette_size. The first eight differ by their hue.
Rgb paletteColor(std::size_t index);

constexpr std::size_t palette_size = 24;

/// The colour of an object in pictures, markers and plots: that of its place in the codebook. A stranger has the first
/// colour that no object has.
/// @param objects of the codebook
Rgb objectColor(const std::vector<std::string>& objects, const std::string& object);

/// "#f07800"
std::string hexText(Rgb color);

}  // namespace sks
