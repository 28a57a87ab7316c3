// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_colors.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "io/point_fields.hpp"

namespace sks {
namespace {

constexpr float slack = 0.001f;  // reals that were computed may be a little above 1

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

std::optional<std::size_t> indexOfName(const std::vector<std::string>& names, const std::string& name) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const std::string& other) { return lowerCase(other) == name; });
  if (found == names.end()) return std::nullopt;
  return std::size_t(found - names.begin());
}

bool isReal(std::uint8_t type) {
  return type == PointField::float32 || type == PointField::float64;
}

bool isByte(std::uint8_t type) {
  return type == PointField::uint8 || type == PointField::int8;
}

/// What the channels are to be multiplied with for 255 to be full brightness.
float factorTo255(const std::vector<Eigen::Vector3f>& channels, const std::array<std::uint8_t, 3>& types) {
  if (std::all_of(types.begin(), types.end(), isByte)) return 1;
  float largest = 0;
  for (const Eigen::Vector3f& channel : channels) {
    for (int i = 0; i < 3; ++i) {
      if (std::isfinite(channel[i]) && channel[i] > largest) largest = channel[i];
    }
  }
  if (std::any_of(types.begin(), types.end(), isReal) && largest <= 1 + slack) return 255;
  if (largest <= 255 + slack) return 1;
  if (largest <= 65535 + slack) return 255 / 65535.0f;
  throw Error(ErrorCode::bad_data,
              formatted("its colours go up to %g; full brightness must be 1 (reals), 255 or 65535", double(largest)));
}

}  // namespace

std::optional<std::size_t> packedColorField(const std::vector<std::string>& names) {
  const auto rgb = indexOfName(names, "rgb");
  return rgb ? rgb : indexOfName(names, "rgba");
}

std::optional<std::array<std::size_t, 3>> colorChannelFields(const std::vector<std::string>& names) {
  constexpr const char* families[][3] = {
      {"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}};
  for (const auto& family : families) {
    const auto red = indexOfName(names, family[0]), green = indexOfName(names, family[1]),
               blue = indexOfName(names, family[2]);
    if (red && green && blue) return std::array<std::size_t, 3>{*red, *green, *blue};
  }
  return std::nullopt;
}

Rgb unpackedColor(std::uint32_t packed) {
  return {std::uint8_t(packed >> 16), std::uint8_t(packed >> 8), std::uint8_t(packed)};
}

std::vector<Rgb> colorsOfChannels(const std::vector<Eigen::Vector3f>& channels,
                                  const std::array<std::uint8_t, 3>& types) {
  const float factor = factorTo255(channels, types);
  const auto byte = [&](float value, std::uint8_t type) {
    if (type == PointField::int8 && value < 0) value += 256;  // `char` in files that mean bytes
    return value > 0 ? std::uint8_t(std::lround(std::min(factor * value, 255.0f))) : std::uint8_t(0);
  };
  std::vector<Rgb> colors;
  colors.reserve(channels.size());
  for (const Eigen::Vector3f& c : channels) {
    colors.push_back({byte(c.x(), types[0]), byte(c.y(), types[1]), byte(c.z(), types[2])});
  }
  return colors;
}

std::vector<Rgb> statedColors(const std::vector<Eigen::Vector3f>& channels, const std::array<std::uint8_t, 3>& types) {
  const bool all = std::all_of(channels.begin(), channels.end(), [](const auto& c) { return c.allFinite(); });
  return all ? colorsOfChannels(channels, types) : std::vector<Rgb>();
}

}  // namespace sks
