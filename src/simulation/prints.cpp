// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/prints.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/scene_random.hpp"

namespace sks {
namespace {

/// A number in [0, 1) for a cell of a pattern.
float cellNumber(std::uint64_t seed, const Eigen::Vector3f& p, float cell) {
  const auto index = [&](float x) { return std::uint64_t(std::int64_t(std::floor(x / cell)) + (1 << 20)); };
  return float(PixelRandom(seed, index(p.x()), (index(p.y()) << 24) ^ index(p.z())).uniform());
}

Rgb scaled(const Rgb& color, float factor) {
  const auto channel = [&](std::uint8_t c) { return std::uint8_t(std::clamp(factor * float(c), 0.0f, 255.0f)); };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

}  // namespace

Paint packagePrint(PixelRandom& random, float size) {
  std::array<Rgb, 4> palette;  // of a package: one strong colour, another, bright and dark
  palette[0] = anyColor(random, 20, 240);
  palette[1] = anyColor(random, 20, 240);
  palette[2] = anyColor(random, 200, 250);
  palette[3] = anyColor(random, 10, 60);
  const auto seed = std::uint64_t(random.uniform() * 1e15);
  return [=](const Eigen::Vector3f& p) -> Rgb {
    int side = 0;
    p.cwiseAbs().maxCoeff(&side);
    const int face = 2 * side + (p[side] > 0 ? 1 : 0);
    const Eigen::Vector3f q(p[(side + 1) % 3] / size, p[(side + 2) % 3] / size, float(face));
    PixelRandom layout(seed, std::uint64_t(face), 0);
    const auto number = [&](float low, float high) { return low + (high - low) * float(layout.uniform()); };
    const float band = number(-0.4f, 0.4f), band_height = number(0.05f, 0.2f);
    const float disc_x = number(-0.3f, 0.3f), disc_y = number(-0.4f, 0.4f), disc = number(0.08f, 0.25f);
    const float text_low = number(-0.5f, 0.1f), text_high = text_low + number(0.1f, 0.4f);
    if (std::hypot(q.x() - disc_x, q.y() - disc_y) < disc) return palette[2];
    if (std::abs(q.y() - band) < band_height) return palette[1];
    if (q.y() > text_low && q.y() < text_high && cellNumber(seed, q, 0.04f) < 0.45f) return palette[3];
    return palette[0];
  };
}

Paint groundPattern(PixelRandom& random) {
  const std::size_t kind = below(random, 4);
  const float bright = float(between(random, 60, 230)), warm = float(between(random, 0.75, 1.1));
  const Rgb base = scaled({255, 255, 255}, bright / 255);
  const Rgb color{base.r, std::uint8_t(float(base.g) * (0.5f + 0.5f * std::min(1.0f, warm))),
                  std::uint8_t(float(base.b) * std::min(1.0f, warm))};
  const auto seed = std::uint64_t(random.uniform() * 1e15);
  const float cell = float(between(random, 0.05, 0.12)), contrast = float(between(random, 0.1, 0.6));
  if (kind == 0) return plain(color);
  if (kind == 1) {  // planks along x with a grain
    return [=](const Eigen::Vector3f& p) {
      const Eigen::Vector3f plank(0, p.y(), 0), grain(0.05f * p.x(), p.y(), 0);
      return scaled(color, 1 - 0.5f * contrast * cellNumber(seed, plank, 1.5f * cell) -
                               0.3f * contrast * cellNumber(seed + 1, grain, 0.006f));
    };
  }
  if (kind == 2) {  // squares
    return [=](const Eigen::Vector3f& p) {
      const bool dark = (int(std::floor(p.x() / cell)) + int(std::floor(p.y() / cell))) % 2 != 0;
      return dark ? scaled(color, 1 - contrast) : color;
    };
  }
  return [=](const Eigen::Vector3f& p) { return scaled(color, 1 - contrast * cellNumber(seed, p, 0.015f)); };
}

}  // namespace sks
