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

SurfaceWeigher::SurfaceWeigher(const TrainingView& view) : view_(view), grid_(view.surface_points, weight_radius) {
  const auto sorted = [&](const std::vector<Eigen::Vector3f>& vectors, Padded& padded) {
    padded.reserve(vectors.size());
    for (const std::uint32_t i : grid_.source) padded.push_back(vectors[i].homogeneous());
  };
  sorted(view.surface_normals, normals_);
  if (!view.surface_colors.empty()) sorted(view.surface_colors, colors_);
}

/// Notes which points lie around a place. @return how many
std::size_t SurfaceWeigher::lookAround(const Eigen::Vector3f& center) {
  grid_.findRuns(center, weight_radius, runs_);
  std::size_t most = 0, count = 0;
  for (const PointGrid::Run& run : runs_) most += run.end - run.begin;
  around_.resize(std::max(around_.size(), most + 1));
  for (const PointGrid::Run& run : runs_) {
    for (std::uint32_t i = run.begin; i < run.end; ++i) {  // without a jump that half of the points take
      const float dx = grid_.x[i] - center.x(), dy = grid_.y[i] - center.y(), dz = grid_.z[i] - center.z();
      around_[count] = i;
      count += dx * dx + dy * dy + dz * dz <= weight_radius * weight_radius ? 1 : 0;
    }
  }
  return count;
}

SurfaceWeight SurfaceWeigher::at(std::size_t point) {
  const std::size_t count = lookAround(view_.surface_points[point]);
  SurfaceWeight weight;
  if (count == 0) return weight;
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  for (std::size_t k = 0; k < count; ++k) sum += normals_[around_[k]];
  weight.shape = std::max(0.0f, 1 - Eigen::Vector3f(sum.head<3>()).norm() / float(count));
  weight.shape_and_color = std::min(1.0f, weight.shape + color_weight * colorVariation(count));
  return weight;
}

/// Of the first points of around_; in [0, 1).
float SurfaceWeigher::colorVariation(std::size_t count) const {
  if (colors_.empty()) return 0;
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  for (std::size_t k = 0; k < count; ++k) sum += colors_[around_[k]];
  const Eigen::Vector3f mean = Eigen::Vector3f(sum.head<3>()) / float(count);
  float squared = 0;
  for (std::size_t k = 0; k < count; ++k) squared += squaredColorDifference(mean, colors_[around_[k]].head<3>());
  squared /= float(count);
  return squared / (squared + common_spread * common_spread);
}

SurfaceWeights::SurfaceWeights(const TrainingView& view) {
  weighEvery(view, 1);
}

void SurfaceWeights::weighEvery(const TrainingView& view, std::size_t stride, std::size_t known_stride) {
  shape.resize(view.surface_points.size());
  shape_and_color.resize(view.surface_points.size());
  SurfaceWeigher weigher(view);
  for (std::size_t i = 0; i < view.surface_points.size(); i += stride) {
    if (known_stride > 0 && i % known_stride == 0) continue;
    const SurfaceWeight weight = weigher.at(i);
    shape[i] = weight.shape;
    shape_and_color[i] = weight.shape_and_color;
  }
}

const SurfaceWeights& WeightsOfViews::at(std::size_t view, std::size_t stride) const {
  const TrainingView& surface = views_[view];
  const std::size_t coarse = strideFor(surface, few_points_);
  Entry& entry = entries_[view];
  std::call_once(entry.some, [&] { entry.weights.weighEvery(surface, coarse); });
  // Others may read what is known meanwhile: it is left alone.
  if (stride % coarse != 0) std::call_once(entry.all, [&] { entry.weights.weighEvery(surface, 1, coarse); });
  return entry.weights;
}

}  // namespace sks
