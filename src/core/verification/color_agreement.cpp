// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/color_agreement.hpp"

#include <cmath>

#include <sks_detector/stages/point_grid.hpp>

namespace sks {
namespace {

constexpr float common_spread = 20;  // of the colours of a print, in units of CIELab: varies by half

}  // namespace

float squaredColorDifference(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f units(50, 120, 120);  // of the scaled colours; of lightness half
  return (a - b).cwiseProduct(units).squaredNorm();
}

float colorAgreement(float squared_difference, float tolerance) {
  return std::exp(-0.5f * squared_difference / (tolerance * tolerance));
}

std::vector<float> colorVariation(const TrainingView& view, float radius) {
  std::vector<float> variation(view.surface_points.size(), 0.0f);
  if (view.surface_colors.empty()) return variation;
  const PointGrid grid(view.surface_points, radius);
  std::vector<PointGrid::Run> runs;
  for (std::size_t i = 0; i < variation.size(); ++i) {
    const auto forEachColor = [&](auto&& f) {
      grid.forEachNeighbor(view.surface_points[i], radius, runs,
                           [&](std::uint32_t j, float) { f(view.surface_colors[grid.source[j]]); });
    };
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    forEachColor([&](const Eigen::Vector3f& color) {
      sum += color;
      ++count;
    });
    const Eigen::Vector3f mean = sum / float(count);  // of the point itself at least
    float squared = 0;
    forEachColor([&](const Eigen::Vector3f& color) { squared += squaredColorDifference(mean, color); });
    squared /= float(count);
    variation[i] = squared / (squared + common_spread * common_spread);
  }
  return variation;
}

}  // namespace sks
