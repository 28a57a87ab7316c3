// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/color_space.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

std::array<float, 256> linearTable() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double value = i / 255.0;
    table[i] = float(value > 0.04045 ? std::pow((value + 0.055) / 1.055, 2.4) : value / 12.92);
  }
  return table;
}

/// The cube root of CIELab with its linear part near 0, tabulated over 0 to 1.
class LabCurve {
public:
  LabCurve() {
    for (int i = 0; i < steps + 2; ++i) {
      const double t = double(i) / steps;
      table_[i] = float(t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0);
    }
  }

  /// Interpolated linearly: wrong by 1e-5 at most.
  float operator()(float t) const {
    const float position = std::min(t, 1.0f) * steps;
    const int i = int(position);
    return table_[i] + (position - float(i)) * (table_[i + 1] - table_[i]);
  }

private:
  static constexpr int steps = 4096;
  std::array<float, steps + 2> table_;
};

}  // namespace

std::array<float, 3> toScaledLab(const Rgb& color) {
  static const std::array<float, 256> linear = linearTable();
  static const LabCurve curve;
  const float r = linear[color.r], g = linear[color.g], b = linear[color.b];
  const float fx = curve((0.412453f * r + 0.357580f * g + 0.180423f * b) / 0.95047f);
  const float fy = curve(0.212671f * r + 0.715160f * g + 0.072169f * b);
  const float fz = curve((0.019334f * r + 0.119193f * g + 0.950227f * b) / 1.08883f);
  return {(116.0f * fy - 16.0f) / 100.0f, 500.0f * (fx - fy) / 120.0f, 200.0f * (fy - fz) / 120.0f};
}

Rgb fromScaledLab(const std::array<float, 3>& color) {
  const double fy = (100.0 * color[0] + 16.0) / 116.0;
  const double fx = fy + 120.0 * color[1] / 500.0, fz = fy - 120.0 * color[2] / 200.0;
  const auto cube = [](double f) { return f * f * f > 0.008856 ? f * f * f : (f - 16.0 / 116.0) / 7.787; };
  const double x = 0.95047 * cube(fx), y = cube(fy), z = 1.08883 * cube(fz);
  const auto level = [](double linear) {
    const double value = linear > 0.0031308 ? 1.055 * std::pow(linear, 1 / 2.4) - 0.055 : 12.92 * linear;
    return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  return {level(3.240479 * x - 1.537150 * y - 0.498535 * z), level(-0.969256 * x + 1.875992 * y + 0.041556 * z),
          level(0.055648 * x - 0.204043 * y + 1.057311 * z)};
}

}  // namespace sks
