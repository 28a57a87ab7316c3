// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace sks {

/// A line through these points; one point twice is a dot. x to the right, y downwards from the top of capital letters.
using Stroke = std::vector<Eigen::Vector2d>;

/// Strokes of a printable ASCII character, of `?` for others. Capital letters are stroke_capitals high.
const std::vector<Stroke>& glyph(char character);

constexpr double stroke_capitals = 6;  ///< height of capital letters
constexpr double stroke_width = 4;     ///< of each character
constexpr double stroke_advance = 6;   ///< from one character to the next

}  // namespace sks
