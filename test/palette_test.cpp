// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/palette.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace sks {
namespace {

/// [degrees]
double hueOf(const Rgb& color) {
  const double r = color.r, g = color.g, b = color.b;
  return std::atan2(std::sqrt(3.0) * (g - b), 2 * r - g - b) * 180 / M_PI;
}

double angleBetween(double a, double b) {
  return std::abs(std::remainder(a - b, 360.0));
}

/// Relative luminance of WCAG.
double luminance(const Rgb& color) {
  const auto linear = [](std::uint8_t byte) {
    const double value = byte / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

double contrast(const Rgb& a, const Rgb& b) {
  const double of_a = luminance(a) + 0.05, of_b = luminance(b) + 0.05;
  return std::max(of_a, of_b) / std::min(of_a, of_b);
}

}  // namespace

TEST(Palette, TheFirstColoursDifferByHue) {
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT(angleBetween(hueOf(paletteColor(i)), hueOf(paletteColor(k))), 20) << i << " and " << k;
    }
  }
}

TEST(Palette, AllColoursDifferAndAreReadableOnDarkAndOnLight) {
  for (std::size_t i = 0; i < palette_size; ++i) {
    const Rgb a = paletteColor(i);
    EXPECT_GT(contrast(a, {255, 255, 255}), 2.1) << i;
    EXPECT_GT(contrast(a, {48, 48, 48}), 2.1) << i;
    for (std::size_t k = 0; k < i; ++k) {
      const Rgb b = paletteColor(k);
      EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 40) << i << " and " << k;
    }
  }
}

TEST(Palette, ObjectsHaveTheColoursOfTheirPlacesInTheCodebook) {
  const std::vector<std::string> objects{"mug", "can"};
  EXPECT_EQ(hexText(objectColor(objects, "mug")), "#f07800");
  EXPECT_EQ(hexText(objectColor(objects, "can")), hexText(paletteColor(1)));
  EXPECT_EQ(hexText(objectColor(objects, "stranger")), hexText(paletteColor(2)));
}

}  // namespace sks
