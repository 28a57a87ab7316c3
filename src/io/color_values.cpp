// SPDX-License-Identifier: BSD-3-Clause
#include "io/color_values.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

float rangeOf(const std::vector<float>& channels, bool whole_numbers) {
  constexpr float a_little_above_one = 1.5f;  // of renderers that do not clamp
  const float largest = channels.empty() ? 0 : *std::max_element(channels.begin(), channels.end());
  if (!whole_numbers && largest <= a_little_above_one) return 1;
  return largest <= 255 ? 255 : 65535;
}

}  // namespace

std::vector<Rgb> colorsOf(const std::vector<float>& channels, bool whole_numbers) {
  std::vector<Rgb> colors;
  if (!std::all_of(channels.begin(), channels.end(), [](float value) { return std::isfinite(value); })) return colors;
  const float range = rangeOf(channels, whole_numbers);
  const auto byte = [&](float value) { return std::uint8_t(std::lround(255 * std::clamp(value / range, 0.0f, 1.0f))); };
  colors.reserve(channels.size() / 3);
  for (std::size_t i = 0; i + 2 < channels.size(); i += 3) {
    colors.push_back({byte(channels[i]), byte(channels[i + 1]), byte(channels[i + 2])});
  }
  return colors;
}

}  // namespace sks
