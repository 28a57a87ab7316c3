// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/surface/angular_spacing.hpp"

namespace sks {
namespace {

constexpr double most_cells = 1 << 20;
constexpr std::size_t direction_samples = 4096;
constexpr float spacings_per_cell = 2;  // few cells within a surface stay empty

/// Where most points lie as seen from the sensor, from a sample of them.
Eigen::Vector3f viewDirection(const Surface& scene) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < scene.size(); i += scene.size() / direction_samples + 1) {
    sum += (scene.point(i) - scene.sensor_origin).stableNormalized();
  }
  return sum.norm() > 0 ? sum.normalized() : Eigen::Vector3f::UnitZ();
}

}  // namespace

RangeImage::RangeImage(const Surface& scene, float radius, int threads) {
  Projection& image = projection_;
  image.origin = scene.sensor_origin;
  const Eigen::Vector3f view = viewDirection(scene);
  image.axes.row(0) = view.unitOrthogonal();
  image.axes.row(1) = view.cross(Eigen::Vector3f(image.axes.row(0)));
  image.axes.row(2) = view;

  std::vector<Eigen::Vector3f> projected(scene.size());
  float low_u = std::numeric_limits<float>::max(), low_v = low_u, high_u = -low_u, high_v = high_u;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min                           \
                                                                         : low_u, low_v) reduction(max \
                                                                                                   : high_u, high_v)
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3f p = projected[i] = project(scene.point(i));
    if (p.z() < 0) continue;
    low_u = std::min(low_u, p.x());
    low_v = std::min(low_v, p.y());
    high_u = std::max(high_u, p.x());
    high_v = std::max(high_v, p.y());
  }
  if (low_u > high_u) return;
  const Eigen::Vector2f size(high_u - low_u, high_v - low_v);
  const float spacing = angularSpacing(scene, radius);
  sensor_spacing_ = spacing / scene.step;
  image.cell = std::max(spacings_per_cell * spacing, 1e-6f);
  image.cell = std::max(image.cell, float(std::sqrt(double(size.x()) * size.y() / most_cells)));
  image.cell = std::max(image.cell, float(size.maxCoeff() / most_cells));
  image.u0 = low_u;
  image.v0 = low_v;
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
