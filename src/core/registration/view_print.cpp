// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_print.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/surface/color_space.hpp"

namespace sks {
namespace {

constexpr float print_blur = 0.0045f, surroundings = 0.014f;  // radii [m]
constexpr float same_side = 0.8f;  // cosine between normals: light falls on other sides otherwise
constexpr float black = 0.1f;      // of the median brightness, is added: ratios of what is darker are noise
constexpr float srgb_gamma = 2.2f;

/// Linear, and 1 at the median brightness: cameras expose each picture as they like.
std::vector<Eigen::Vector3f> exposedColors(const Surface& surface) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = std::pow(float(i) / 255, srgb_gamma);
  std::vector<Eigen::Vector3f> colors;
  std::vector<float> brightness;
  for (const auto& color : surface.color) {
    const Rgb rgb = fromScaledLab(color);
    colors.emplace_back(linear[rgb.r], linear[rgb.g], linear[rgb.b]);
    brightness.push_back(colors.back().mean());
  }
  const auto middle = brightness.begin() + std::ptrdiff_t(brightness.size() / 2);
  std::nth_element(brightness.begin(), middle, brightness.end());
  const float scale = 1 / std::max(linear[1], *middle);
  for (Eigen::Vector3f& color : colors) color = (scale * color.array() + black).matrix();
  return colors;
}

}  // namespace

std::vector<Eigen::Vector3f> printsOf(const Surface& surface) {
  std::vector<Eigen::Vector3f> prints;
  if (!surface.hasColor() || surface.size() == 0) return prints;
  const std::vector<Eigen::Vector3f> colors = exposedColors(surface);
  std::vector<PointGrid::Run> runs;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f n = surface.normal(i);
    Eigen::Vector3f near = Eigen::Vector3f::Zero(), around = Eigen::Vector3f::Zero();
    float count = 0, wide = 0;
    surface.forEachNeighbor(surface.point(i), surroundings, runs, [&](std::uint32_t j, float squared) {
      if (j != i && !(n.dot(surface.normal(j)) > same_side)) return;
      around += colors[j];
      ++wide;
      if (squared > print_blur * print_blur) return;
      near += colors[j];
      ++count;
    });
    near /= count;
    around /= wide;
    prints.emplace_back(std::log(near.sum() / around.sum()), std::log(near[0] / near[1]), std::log(near[2] / near[1]));
  }
  return prints;
}

}  // namespace sks
