// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "io/image_file.hpp"

namespace sks {

struct PictureSize {
  int width, height;
};

/// Pixels x to x + width - 1 and y to y + height - 1.
struct PixelBox {
  int x, y, width, height;

  bool overlaps(const PixelBox& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
  }
};

/// Draws a line with smooth edges and round ends. The centre of a pixel has whole coordinates (column, row).
/// @param thickness [pixels]
void drawLine(ColorImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb color, double thickness);

/// Fills what of the box lies in the image.
void fillBox(ColorImage& image, const PixelBox& box, Rgb color);

/// Draws a line of text. @param baseline left end of the line that the letters stand on
void drawText(ColorImage& image, const std::string& text, const Eigen::Vector2d& baseline, Rgb color);

/// Width of the text and height of its capital letters [pixels].
PictureSize textSize(const std::string& text);

}  // namespace sks
