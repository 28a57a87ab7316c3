// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/palette.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "core/settings/number_format.hpp"

namespace sks {
namespace {

// Eight hues with 45 degrees between them, far ones following each other; then always the colour that is furthest from
// those before (in OKLab), of those with a contrast of at least 2.2 to white and to the dark grey of rviz (48, 48, 48).
constexpr std::uint32_t palette[] = {0xf07800, 0x18a8f0, 0x00c008, 0xe858e8, 0x908000, 0x6868f8, 0x009890, 0xe03060,
                                     0x805888, 0xc8a0d0, 0xa808c8, 0x98b880, 0x007800, 0xa84810, 0x0068b0, 0xb87880,
                                     0xa868c8, 0xf870a0, 0x087068, 0xe000a8, 0x6880b8, 0x18c0c0, 0xd8a800, 0x0050f8};
static_assert(std::size(palette) == palette_size);

}  // namespace

Rgb paletteColor(std::size_t index) {
  const std::uint32_t color = palette[index % palette_size];
  return {std::uint8_t(color >> 16), std::uint8_t(color >> 8), std::uint8_t(color)};
}

Rgb objectColor(const std::vector<std::string>& objects, const std::string& object) {
  return paletteColor(std::size_t(std::find(objects.begin(), objects.end(), object) - objects.begin()));
}

std::string hexText(Rgb color) {
  return formatted("#%02x%02x%02x", color.r, color.g, color.b);
}

}  // namespace sks
