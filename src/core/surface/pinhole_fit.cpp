// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/pinhole_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace sks {
namespace {

constexpr double max_deviation = 0.5;  // [pixel]
constexpr std::size_t pinhole_sample = 2000;

/// Line y = slope * x + offset through points, by least squares.
class LineFit {
public:
  void add(double x, double y) {
    ++n_;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }

  /// Slope and offset.
  std::pair<double, double> line() const {
    const double slope = (n_ * xy_ - x_ * y_) / (n_ * xx_ - x_ * x_);
    return {slope, (y_ - slope * x_) / n_};
  }

private:
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;
};

}  // namespace

std::optional<Pinhole> fitPinhole(const Cloud& cloud, int threads) {
  const std::size_t n = cloud.pixels.size();
  if (n == 0 || n != cloud.size()) return std::nullopt;
  LineFit columns, rows;
  for (std::size_t i = 0; i < n; i += std::max<std::size_t>(1, n / pinhole_sample)) {
    const Eigen::Vector3f& p = cloud.points[i];
    const std::uint32_t row = cloud.pixels[i] / cloud.columns;
    columns.add(p.x() / p.z(), cloud.pixels[i] % cloud.columns);
    rows.add(p.y() / p.z(), row);
  }
  Pinhole camera;
  std::tie(camera.focal_x, camera.center_x) = columns.line();
  std::tie(camera.focal_y, camera.center_y) = rows.line();
  if (!std::isfinite(camera.focal_x + camera.focal_y)) return std::nullopt;

  const float fx = float(camera.focal_x), cx = float(camera.center_x), fy = float(camera.focal_y),
              cy = float(camera.center_y);
  float nearest = std::numeric_limits<float>::max(), deviation = 0, widest = 0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min                      \
                                                                         : nearest) reduction(max \
                                                                                              : deviation, widest)
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    const std::uint32_t row = cloud.pixels[i] / cloud.columns, column = cloud.pixels[i] - row * cloud.columns;
    const float inverse = 1.0f / p.z();
    nearest = std::min(nearest, p.z());
    widest = std::max(widest, p.norm() * inverse);
    deviation = std::max(deviation, std::abs(fx * p.x() * inverse + cx - float(column)));
    deviation = std::max(deviation, std::abs(fy * p.y() * inverse + cy - float(row)));
  }
  camera.nearest = nearest;
  camera.deviation = deviation;
  camera.widest = widest;
  if (!(nearest > 0 && deviation <= max_deviation)) return std::nullopt;
  return camera;
}

}  // namespace sks
