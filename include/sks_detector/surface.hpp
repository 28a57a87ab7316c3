// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// A prepared cloud: structure of arrays and one neighbour search that every stage reads.
///
/// Points are stored in the order of the search: by row (a square column of the y-z plane), within a row by x. The
/// neighbours of a place then are a few runs of consecutive points.
class Surface {
public:
  /// Half-open range of point indices.
  struct Run {
    std::uint32_t begin;
    std::uint32_t end;
  };

  /// Sorts the points of a sanitized cloud; normals are left empty (see estimateNormals()).
  /// @param cell edge of a row [m]; best at about the smallest search radius
  Surface(const Cloud& cloud, double cell);

  std::size_t size() const { return x.size(); }
  bool hasColor() const { return !color.empty(); }
  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Eigen::Vector3f normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }

  /// Calls `f(Run)` for each run of points that may lie within `radius` of `center`; the distance is the caller's test.
  template <typename Function>
  void forEachRun(const Eigen::Vector3f& center, float radius, Function&& f) const;

  std::vector<float> x, y, z;               ///< positions [m]
  std::vector<float> nx, ny, nz;            ///< unit normals; NaN where none could be estimated
  std::vector<std::array<float, 3>> color;  ///< CIELab scaled to [0, 1], [-1, 1], [-1, 1]; empty without colour
  std::vector<std::uint32_t> source;        ///< index of each point in the cloud it was made from
  Eigen::Vector3f sensor_origin = Eigen::Vector3f::Zero();  ///< [m]

private:
  float origin_y_ = 0, origin_z_ = 0;  // lower corner of row (0, 0)
  float cell_ = 1;
  int rows_y_ = 0, rows_z_ = 0;
  std::vector<std::uint32_t> row_begin_;  // first point of each row, and one past the last
};

template <typename Function>
void Surface::forEachRun(const Eigen::Vector3f& center, float radius, Function&& f) const {
  const float inverse = 1.0f / cell_;
  const auto row = [&](float value, float origin, int count) {
    const float index = (value - origin) * inverse;
    return index < 0.0f ? 0 : (index >= float(count) ? count - 1 : int(index));
  };
  if (size() == 0) return;
  const float gap_y = center.y() - origin_y_, gap_z = center.z() - origin_z_;
  if (gap_y + radius < 0 || gap_z + radius < 0) return;
  if (gap_y - radius > rows_y_ * cell_ || gap_z - radius > rows_z_ * cell_) return;
  const int y0 = row(center.y() - radius, origin_y_, rows_y_), y1 = row(center.y() + radius, origin_y_, rows_y_);
  const int z0 = row(center.z() - radius, origin_z_, rows_z_), z1 = row(center.z() + radius, origin_z_, rows_z_);
  const auto outside = [&](float gap, int index) {  // distance from the centre to the row's slab
    const float low = index * cell_ - gap, high = gap - (index + 1) * cell_;
    return low > 0 ? low : (high > 0 ? high : 0.0f);
  };
  const float slack = radius * 1e-4f;  // rounding must not lose a point at the rim
  for (int j = z0; j <= z1; ++j) {
    const float dz = outside(gap_z, j);
    for (int i = y0; i <= y1; ++i) {
      const std::size_t r = std::size_t(j) * rows_y_ + i;
      const std::uint32_t begin = row_begin_[r], end = row_begin_[r + 1];
      if (begin == end) continue;
      const float dy = outside(gap_y, i);
      const float rest = radius * radius - dy * dy - dz * dz;
      if (rest < -slack * radius) continue;
      const float half = std::sqrt(rest > 0 ? rest : 0.0f) + slack;
      const auto first = std::lower_bound(x.begin() + begin, x.begin() + end, center.x() - half);
      const auto last = std::upper_bound(first, x.begin() + end, center.x() + half);
      if (first != last) f(Run{std::uint32_t(first - x.begin()), std::uint32_t(last - x.begin())});
    }
  }
}

/// How normals are turned.
enum class Orientation {
  sensor,  ///< towards the sensor origin: scenes and views
  outward  ///< away from the inside: full models
};

/// Estimates and orients the normal at every point. Deterministic for any number of threads.
void estimateNormals(Surface& surface, const SurfaceSettings& settings, Orientation orientation, int threads);

/// The plane normal of the points around `center`, oriented like the surface's own normals there; NaN if there are
/// fewer than `min_neighbors` points.
Eigen::Vector3f normalAt(const Surface& surface, const Eigen::Vector3f& center, double radius, int min_neighbors);

/// A sanitized cloud, thinned, sorted and with normals: the input of every later stage.
Surface prepareSurface(const Cloud& sanitized, const SurfaceSettings& settings, Orientation orientation, int threads);

/// One point per occupied cube of the given edge: the one nearest to the centroid of the cube's points.
Cloud thin(const Cloud& cloud, double edge);

}  // namespace sks
