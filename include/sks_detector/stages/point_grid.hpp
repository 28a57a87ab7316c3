// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace sks {

/// Points in the order of their neighbour search, structure of arrays.
///
/// Points are sorted by row (a square column of the y-z plane along x), within a row by x. The neighbours of a position
/// then are a few runs of consecutive points: no pointers, no tree, and every run can be read with SIMD loads.
/// Thread-safe once built.
class PointGrid {
public:
  /// Half-open range of point indices.
  struct Run {
    std::uint32_t begin;
    std::uint32_t end;
  };

  PointGrid() = default;
  /// @param points finite positions [m]
  /// @param cell edge of a row [m], best at about the smallest search radius; enlarged where the extent of the points
  ///        would make too many rows
  /// @param threads for sorting; the result does not depend on them
  PointGrid(const std::vector<Eigen::Vector3f>& points, double cell, int threads = 1);

  std::size_t size() const { return source.size(); }
  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  std::vector<Eigen::Vector3f> positions() const;

  /// Replaces `runs` by all that may hold points within `radius` of `center`; the distance test is the caller's.
  void findRuns(const Eigen::Vector3f& center, float radius, std::vector<Run>& runs) const;

  /// Replaces `rows` by all rows that may hold points within `radius` of any point in the row of point `i`. Points of a
  /// row ascend in x. @return one past the last point of the row of `i`
  std::uint32_t findRows(std::size_t i, float radius, std::vector<Run>& rows) const;

  /// Calls `f(index, squared distance)` for each point within `radius` of `center`, in order of the index.
  template <typename Function>
  void forEachNeighbor(const Eigen::Vector3f& center, float radius, std::vector<Run>& buffer, Function&& f) const {
    findRuns(center, radius, buffer);
    const float limit = radius * radius;
    for (const Run& run : buffer) {
      for (std::uint32_t i = run.begin; i < run.end; ++i) {
        const float dx = x[i] - center.x(), dy = y[i] - center.y(), dz = z[i] - center.z();
        const float squared = dx * dx + dy * dy + dz * dz;
        if (squared <= limit) f(i, squared);
      }
    }
  }

  std::vector<float> x, y, z;         ///< positions [m]; padded by simd_padding entries of infinity
  std::vector<std::uint32_t> source;  ///< index of each point in what the grid was made from

  /// Entries past the last point that may be read.
  static constexpr std::size_t simd_padding = 16;

  /// Where the rows lie, and their points.
  struct Rows {
    float origin_y = 0, origin_z = 0;  ///< lower corner of row (0, 0) [m]
    float cell = 1;                    ///< edge [m]
    int count_y = 0, count_z = 0;
    std::vector<std::uint32_t> begin;  ///< first point of each row (y fastest), and one past the last
    std::vector<float> pivots;  ///< x of every pivot_spacing-th point, by which positions in a row are found; padded

    static constexpr std::uint32_t pivot_spacing = 16;

    std::uint32_t at(float point_y, float point_z) const {
      const int j = std::min(int((point_y - origin_y) / cell), count_y - 1);
      const int k = std::min(int((point_z - origin_z) / cell), count_z - 1);
      return std::uint32_t(k) * std::uint32_t(count_y) + std::uint32_t(j);
    }
  };

private:
  Rows rows_;
};

}  // namespace sks
