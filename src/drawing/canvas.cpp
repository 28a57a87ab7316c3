// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/stroke_font.hpp"

namespace sks {
namespace {

constexpr double text_scale = 2.2, text_thickness = 1.4;  // [pixels]

std::uint8_t blended(std::uint8_t below, std::uint8_t above, double opacity) {
  return std::uint8_t(std::lround(below + opacity * (above - below)));
}

double distanceToLine(const Eigen::Vector2d& point, const Eigen::Vector2d& from, const Eigen::Vector2d& along) {
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - from - t * along).norm();
}

}  // namespace

void drawLine(ColorImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb color, double thickness) {
  const double reach = 0.5 * thickness + 0.5;  // half of the edge's pixels is covered
  const Eigen::Vector2d low = from.cwiseMin(to).array() - reach, high = from.cwiseMax(to).array() + reach;
  const auto within = [](double value, int size) { return int(std::clamp(value, 0.0, double(size))); };
  for (int row = within(std::ceil(low.y()), image.height); row < within(high.y() + 1, image.height); ++row) {
    for (int column = within(std::ceil(low.x()), image.width); column < within(high.x() + 1, image.width); ++column) {
      const double opacity = std::min(1.0, reach - distanceToLine({column, row}, from, to - from));
      if (opacity <= 0) continue;
      Rgb& pixel = image(row, column);
      pixel = {blended(pixel.r, color.r, opacity), blended(pixel.g, color.g, opacity),
               blended(pixel.b, color.b, opacity)};
    }
  }
}

void fillBox(ColorImage& image, const PixelBox& box, Rgb color) {
  for (int row = std::max(box.y, 0); row < std::min(box.y + box.height, image.height); ++row) {
    for (int column = std::max(box.x, 0); column < std::min(box.x + box.width, image.width); ++column) {
      image(row, column) = color;
    }
  }
}

void drawText(ColorImage& image, const std::string& text, const Eigen::Vector2d& baseline, Rgb color) {
  Eigen::Vector2d corner = baseline - Eigen::Vector2d(0, text_scale * stroke_capitals);
  for (const char character : text) {
    for (const Stroke& stroke : glyph(character)) {
      for (std::size_t i = 1; i < stroke.size(); ++i) {
        drawLine(image, corner + text_scale * stroke[i - 1], corner + text_scale * stroke[i], color, text_thickness);
      }
    }
    corner.x() += text_scale * stroke_advance;
  }
}

PictureSize textSize(const std::string& text) {
  const double advances = text.empty() ? 0 : stroke_advance * double(text.size() - 1) + stroke_width;
  return {int(std::ceil(text_scale * advances)), int(std::ceil(text_scale * stroke_capitals))};
}

}  // namespace sks
