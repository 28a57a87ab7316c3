// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/surface_weights.hpp"

#include <algorithm>

#include "core/verification/color_agreement.hpp"

namespace sks {
namespace {

constexpr float weight_radius = 0.02f;  // [m] the scale of the keypoints' local surfaces
constexpr float color_weight = 0.5f;    // of varying colours beside varying normals
constexpr float common_spread = 20;     // of the colours of a print, in units of CIELab: varies by half

}  // namespace

SurfaceWeigher::SurfaceWeigher(const TrainingView& view) : view_(view), grid_(view.surface_points, weight_radius) {}

SurfaceWeight SurfaceWeigher::at(std::size_t point) {
  around_.clear();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  grid_.forEachNeighbor(view_.surface_points[point], weight_radius, runs_, [&](std::uint32_t j, float) {
    around_.push_back(grid_.source[j]);
    sum += view_.surface_normals[around_.back()];
  });
  SurfaceWeight weight;
  if (!around_.empty()) weight.shape = std::max(0.0f, 1 - sum.norm() / float(around_.size()));
  weight.shape_and_color = std::min(1.0f, weight.shape + color_weight * colorVariation());
  return weight;
}

/// In [0, 1).
float SurfaceWeigher::colorVariation() const {
  if (view_.surface_colors.empty() || around_.empty()) return 0;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t i : around_) sum += view_.surface_colors[i];
  const Eigen::Vector3f mean = sum / float(around_.size());
  float squared = 0;
  for (const std::uint32_t i : around_) squared += squaredColorDifference(mean, view_.surface_colors[i]);
  squared /= float(around_.size());
  return squared / (squared + common_spread * common_spread);
}

SurfaceWeights::SurfaceWeights(const TrainingView& view) {
  SurfaceWeigher weigher(view);
  shape.reserve(view.surface_points.size());
  shape_and_color.reserve(view.surface_points.size());
  for (std::size_t i = 0; i < view.surface_points.size(); ++i) {
    const SurfaceWeight weight = weigher.at(i);
    shape.push_back(weight.shape);
    shape_and_color.push_back(weight.shape_and_color);
  }
}

}  // namespace sks
