// SPDX-License-Identifier: BSD-3-Clause
#include "core/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace sks {
namespace {

constexpr double most_cells = 1 << 20;
constexpr std::size_t spacing_samples = 500;
constexpr float spacings_per_cell = 2;  // few cells within a surface stay empty

/// Median angle between neighbouring points [rad]; points without a neighbour in reach count as that far apart.
float angularSpacing(const Surface& scene, float radius) {
  std::vector<PointGrid::Run> runs;
  std::vector<float> angles;
  for (std::size_t i = 0; i < scene.size(); i += scene.size() / spacing_samples + 1) {
    float nearest = radius * radius;
    scene.forEachNeighbor(scene.point(i), radius, runs, [&](std::uint32_t j, float squared) {
      if (j != i) nearest = std::min(nearest, squared);
    });
    angles.push_back(std::sqrt(nearest) / std::max((scene.point(i) - scene.sensor_origin).norm(), radius));
  }
  std::nth_element(angles.begin(), angles.begin() + angles.size() / 2, angles.end());
  return angles[angles.size() / 2];
}

}  // namespace

RangeImage::RangeImage(const Surface& scene, float radius) : origin_(scene.sensor_origin) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < scene.size(); ++i) mean += (scene.point(i) - origin_).stableNormalized();
  const Eigen::Vector3f view = mean.norm() > 0 ? mean.normalized() : Eigen::Vector3f::UnitZ();
  axes_.row(0) = view.unitOrthogonal();
  axes_.row(1) = view.cross(Eigen::Vector3f(axes_.row(0)));
  axes_.row(2) = view;

  Eigen::AlignedBox2f bounds;
  std::vector<Eigen::Vector3f> projected(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3f& p = projected[i] = project(scene.point(i));
    if (p.z() >= 0) bounds.extend(p.head<2>());
  }
  if (bounds.isEmpty()) return;
  const Eigen::Vector2f size = bounds.sizes();
  cell_ = std::max(spacings_per_cell * angularSpacing(scene, radius), 1e-6f);
  cell_ = std::max(cell_, float(std::sqrt(double(size.x()) * size.y() / most_cells)));
  cell_ = std::max(cell_, float(size.maxCoeff() / most_cells));
  u0_ = bounds.min().x();
  v0_ = bounds.min().y();
  width_ = int(size.x() / cell_) + 1;
  height_ = int(size.y() / cell_) + 1;
  nearest_.assign(std::size_t(width_) * height_, std::numeric_limits<float>::infinity());
  farthest_.assign(nearest_.size(), -1);
  points_.assign(nearest_.size(), no_point);
  std::vector<float> nearest_normal(nearest_.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3f& p = projected[i];
    if (p.z() < 0) continue;
    const std::size_t cell = std::size_t((p.y() - v0_) / cell_) * width_ + std::size_t((p.x() - u0_) / cell_);
    if (p.z() < nearest_normal[cell] && scene.normal(i).allFinite()) {
      nearest_normal[cell] = p.z();
      points_[cell] = std::uint32_t(i);
    }
    nearest_[cell] = std::min(nearest_[cell], p.z());
    farthest_[cell] = std::max(farthest_[cell], p.z());
  }
}

Eigen::Vector3f RangeImage::project(const Eigen::Vector3f& place) const {
  const Eigen::Vector3f p = axes_ * (place - origin_);
  // Beyond 80 degrees from the direction of view the grid would grow without bounds.
  const float range = p.norm();
  if (p.z() <= 0.17f * range || range == 0) return {0, 0, -1};
  return {p.x() / p.z(), p.y() / p.z(), range};
}

Sighting RangeImage::look(const Eigen::Vector3f& place, float tolerance) const {
  const Eigen::Vector3f p = project(place);
  const float column = std::floor((p.x() - u0_) / cell_), row = std::floor((p.y() - v0_) / cell_);
  if (p.z() < 0 || !(column >= 0 && row >= 0 && column < float(width_) && row < float(height_))) return {};
  const std::size_t cell = std::size_t(row) * width_ + std::size_t(column);
  if (farthest_[cell] < 0) return {};
  if (p.z() < nearest_[cell] - tolerance) return {Sight::in_front, points_[cell]};
  if (p.z() > farthest_[cell] + tolerance) return {Sight::hidden, points_[cell]};
  return {Sight::at, points_[cell]};
}

}  // namespace sks
