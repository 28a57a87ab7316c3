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

RangeImage::RangeImage(const Surface& scene, float radius) {
  Projection& image = projection_;
  image.origin = scene.sensor_origin;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < scene.size(); ++i) mean += (scene.point(i) - image.origin).stableNormalized();
  const Eigen::Vector3f view = mean.norm() > 0 ? mean.normalized() : Eigen::Vector3f::UnitZ();
  image.axes.row(0) = view.unitOrthogonal();
  image.axes.row(1) = view.cross(Eigen::Vector3f(image.axes.row(0)));
  image.axes.row(2) = view;

  Eigen::AlignedBox2f bounds;
  std::vector<Eigen::Vector3f> projected(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3f& p = projected[i] = project(scene.point(i));
    if (p.z() >= 0) bounds.extend(p.head<2>());
  }
  if (bounds.isEmpty()) return;
  const Eigen::Vector2f size = bounds.sizes();
  image.cell = std::max(spacings_per_cell * angularSpacing(scene, radius), 1e-6f);
  image.cell = std::max(image.cell, float(std::sqrt(double(size.x()) * size.y() / most_cells)));
  image.cell = std::max(image.cell, float(size.maxCoeff() / most_cells));
  image.u0 = bounds.min().x();
  image.v0 = bounds.min().y();
  image.width = int(size.x() / image.cell) + 1;
  image.height = int(size.y() / image.cell) + 1;
  cells_.resize(std::size_t(image.width) * std::size_t(image.height));
  points_.assign(cells_.size(), no_point);
  std::vector<float> nearest_normal(cells_.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3f& p = projected[i];
    if (p.z() < 0) continue;
    const std::size_t column = std::size_t((p.x() - image.u0) / image.cell),
                      row = std::size_t((p.y() - image.v0) / image.cell);
    const std::size_t at = row * std::size_t(image.width) + column;
    Cell& cell = cells_[at];
    cell.nearest = std::min(cell.nearest, p.z());
    cell.farthest = std::max(cell.farthest, p.z());
    if (!(p.z() < nearest_normal[at] && scene.normal(i).allFinite())) continue;
    nearest_normal[at] = p.z();
    points_[at] = std::uint32_t(i);
    cell.x = scene.x[i];
    cell.y = scene.y[i];
    cell.z = scene.z[i];
    cell.nx = scene.nx[i];
    cell.ny = scene.ny[i];
    cell.nz = scene.nz[i];
  }
}

}  // namespace sks
