// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/point_grid.hpp>

#include <limits>
#include <numeric>

namespace sks {
namespace {

constexpr double max_rows = 4e6;  // 16 MB of row table, whatever the extent of the points

/// std::lower_bound without branches that depend on the values: no guess of the processor can be wrong.
std::uint32_t firstNotBelow(const float* x, std::uint32_t begin, std::uint32_t end, float value) {
  for (std::uint32_t count = end - begin; count > 0;) {
    const std::uint32_t half = (count + 1) / 2;
    begin += half & -std::uint32_t(x[begin + half - 1] < value);
    count -= half;
  }
  return begin;
}

}  // namespace

PointGrid::PointGrid(const std::vector<Eigen::Vector3f>& points, double cell) {
  const std::size_t n = points.size();
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (const auto& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (n == 0) low = high = Eigen::Vector3f::Zero();
  const Eigen::Vector2d extent = (high - low).tail<2>().cast<double>();
  while ((extent.x() / cell + 1) * (extent.y() / cell + 1) > max_rows) cell *= 2;

  cell_ = float(cell);
  origin_y_ = low.y();
  origin_z_ = low.z();
  rows_y_ = int(extent.x() / cell) + 1;
  rows_z_ = int(extent.y() / cell) + 1;

  // Counting sort by row, then by x within each row; ties keep their order.
  row_begin_.assign(std::size_t(rows_y_) * rows_z_ + 1, 0);
  std::vector<std::uint32_t> row(n);
  for (std::size_t i = 0; i < n; ++i) {
    row[i] = rowOf(points[i].y(), points[i].z());
    ++row_begin_[row[i] + 1];
  }
  std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
  source.resize(n);
  std::vector<std::uint32_t> next(row_begin_.begin(), row_begin_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) source[next[row[i]]++] = std::uint32_t(i);
  for (std::size_t r = 0; r + 1 < row_begin_.size(); ++r) {
    std::stable_sort(source.begin() + row_begin_[r], source.begin() + row_begin_[r + 1],
                     [&](std::uint32_t a, std::uint32_t b) { return points[a].x() < points[b].x(); });
  }

  const float infinity = std::numeric_limits<float>::infinity();
  for (auto* axis : {&x, &y, &z}) axis->assign(n + simd_padding, infinity);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = points[source[i]].x();
    y[i] = points[source[i]].y();
    z[i] = points[source[i]].z();
  }
}

std::uint32_t PointGrid::rowOf(float py, float pz) const {
  const int j = std::min(int((py - origin_y_) / cell_), rows_y_ - 1);
  const int k = std::min(int((pz - origin_z_) / cell_), rows_z_ - 1);
  return std::uint32_t(k) * std::uint32_t(rows_y_) + std::uint32_t(j);
}

std::uint32_t PointGrid::findRows(std::size_t i, float radius, std::vector<Run>& rows) const {
  rows.clear();
  const std::uint32_t own = rowOf(y[i], z[i]);
  const int j = int(own % std::uint32_t(rows_y_)), k = int(own / std::uint32_t(rows_y_));
  const int reach = int(radius * (1 + 1e-3f) / cell_) + 1;  // rounding must not lose a point at the rim
  for (int kk = std::max(k - reach, 0); kk <= std::min(k + reach, rows_z_ - 1); ++kk) {
    for (int jj = std::max(j - reach, 0); jj <= std::min(j + reach, rows_y_ - 1); ++jj) {
      const std::size_t r = std::size_t(kk) * rows_y_ + jj;
      if (row_begin_[r] != row_begin_[r + 1]) rows.push_back({row_begin_[r], row_begin_[r + 1]});
    }
  }
  return row_begin_[own + 1];
}

std::vector<Eigen::Vector3f> PointGrid::positions() const {
  std::vector<Eigen::Vector3f> points(size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = point(i);
  return points;
}

void PointGrid::findRuns(const Eigen::Vector3f& center, float radius, std::vector<Run>& runs) const {
  runs.clear();
  if (size() == 0) return;
  const float inverse = 1.0f / cell_;
  const float gap_y = center.y() - origin_y_, gap_z = center.z() - origin_z_;
  const auto row = [&](float gap, int count) { return int(std::clamp(gap * inverse, 0.0f, float(count - 1))); };
  const int y0 = row(gap_y - radius, rows_y_), y1 = row(gap_y + radius, rows_y_);
  const int z0 = row(gap_z - radius, rows_z_), z1 = row(gap_z + radius, rows_z_);
  const auto outside = [&](float gap, int index) {  // distance from the centre to the slab of row `index`
    return std::max({index * cell_ - gap, gap - (index + 1) * cell_, 0.0f});
  };
  const float slack = radius * 1e-3f;  // rounding must not lose a point at the rim
  const float reach = (radius + slack) * (radius + slack);
  for (int k = z0; k <= z1; ++k) {
    const float dz = outside(gap_z, k);
    for (int j = y0; j <= y1; ++j) {
      const std::size_t r = std::size_t(k) * rows_y_ + j;
      const std::uint32_t begin = row_begin_[r], end = row_begin_[r + 1];
      if (begin == end) continue;
      const float dy = outside(gap_y, j);
      const float rest = reach - dy * dy - dz * dz;
      if (rest < 0) continue;
      const float half = std::sqrt(rest) + slack;
      const std::uint32_t first = firstNotBelow(x.data(), begin, end, center.x() - half);
      const std::uint32_t last = firstNotBelow(x.data(), first, end, center.x() + half);
      if (first != last) runs.push_back({first, last});
    }
  }
}

}  // namespace sks
