// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/simulation/texture.hpp>

#include <algorithm>
#include <cmath>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

/// In [0, 1], whatever the value is: pixels are addressed with it.
float fraction(float value) {
  const float result = value - std::floor(value);
  return result >= 0 && result <= 1 ? result : 0.0f;
}

}  // namespace

Texture::Texture(int width, int height, std::vector<Rgb> pixels) {
  if (width < 1 || height < 1 || pixels.size() != std::size_t(width) * std::size_t(height)) {
    throw Error(ErrorCode::bad_data, "a texture of " + std::to_string(width) + " x " + std::to_string(height) +
                                         " pixels cannot have " + std::to_string(pixels.size()) + " colours");
  }
  levels_.push_back({width, height, std::move(pixels)});
  while (levels_.back().width > 1 && levels_.back().height > 1) levels_.push_back(half(levels_.back()));
}

Texture::Level Texture::half(const Level& level) {
  Level result{level.width / 2, level.height / 2, {}};
  result.pixels.reserve(std::size_t(result.width) * std::size_t(result.height));
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      int sum[3] = {2, 2, 2};  // rounds the mean
      for (int k = 0; k < 4; ++k) {
        const Rgb& c = level.pixels[std::size_t(2 * y + k / 2) * std::size_t(level.width) + std::size_t(2 * x + k % 2)];
        sum[0] += c.r;
        sum[1] += c.g;
        sum[2] += c.b;
      }
      result.pixels.push_back({std::uint8_t(sum[0] / 4), std::uint8_t(sum[1] / 4), std::uint8_t(sum[2] / 4)});
    }
  }
  return result;
}

Rgb Texture::at(float u, float v, float footprint) const {
  const float coarsest = float(levels_.size() - 1);
  const float wanted = footprint > 1 ? std::min(std::round(std::log2(footprint)), coarsest) : 0.0f;
  const Level& level = levels_[std::size_t(wanted)];
  const float x = fraction(u) * float(level.width) - 0.5f;
  const float y = (1 - fraction(v)) * float(level.height) - 0.5f;
  const int column = int(std::floor(x)), row = int(std::floor(y));
  const float right = x - float(column), down = y - float(row);
  float sum[3] = {0.5f, 0.5f, 0.5f};
  for (int k = 0; k < 4; ++k) {
    const int c = (column + k % 2 + level.width) % level.width, r = (row + k / 2 + level.height) % level.height;
    const Rgb& pixel = level.pixels[std::size_t(r) * std::size_t(level.width) + std::size_t(c)];
    const float weight = (k % 2 ? right : 1 - right) * (k / 2 ? down : 1 - down);
    sum[0] += weight * pixel.r;
    sum[1] += weight * pixel.g;
    sum[2] += weight * pixel.b;
  }
  return {std::uint8_t(sum[0]), std::uint8_t(sum[1]), std::uint8_t(sum[2])};
}

}  // namespace sks
