// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/point_grid.hpp>

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "core/surface/counting_sort.hpp"

namespace sks {
namespace {

constexpr double max_rows = 4e6;       // 16 MB of row table, whatever the extent of the points
constexpr float least_width = 1e-30f;  // [m] of what is put in buckets: the inverse of less may overflow

Eigen::AlignedBox3f boundsOf(const std::vector<Eigen::Vector3f>& points, int threads) {
  Eigen::AlignedBox3f bounds;
#pragma omp parallel num_threads(threads)
  {
    Eigen::AlignedBox3f of_share;
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < points.size(); ++i) of_share.extend(points[i]);
#pragma omp critical
    bounds.extend(of_share);
  }
  if (points.empty()) bounds.extend(Eigen::Vector3f::Zero().eval());
  return bounds;
}

PointGrid::Rows rowsIn(const Eigen::AlignedBox3f& bounds, double cell) {
  const Eigen::Vector2d extent = bounds.sizes().tail<2>().cast<double>();
  cell = std::max(cell, double(least_width));  // twice 0 stays 0
  while ((extent.x() / cell + 1) * (extent.y() / cell + 1) > max_rows) cell *= 2;

  PointGrid::Rows rows;
  rows.cell = float(cell);
  rows.origin_y = bounds.min().y();
  rows.origin_z = bounds.min().z();
  rows.count_y = int(extent.x() / cell) + 1;
  rows.count_z = int(extent.y() / cell) + 1;
  return rows;
}

/// A point on its way into order.
struct Entry {
  float x;
  std::uint32_t source;
  std::uint32_t row;
};

/// Points roughly by x: by buckets of equal width, in their order within each.
std::vector<Entry> roughlyByX(const std::vector<Eigen::Vector3f>& points, const Eigen::AlignedBox3f& bounds,
                              const PointGrid::Rows& rows, int threads) {
  constexpr std::uint32_t buckets = 4096;
  const float low = bounds.min().x(), width = bounds.sizes().x();
  const float per_width = width > least_width ? float(buckets) / width : 0.0f;
  std::vector<Entry> entries(points.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i] = {points[i].x(), std::uint32_t(i), rows.at(points[i].y(), points[i].z())};
  }
  std::vector<std::uint32_t> begin;
  const auto bucketOf = [&](const Entry& e) { return std::min(std::uint32_t((e.x - low) * per_width), buckets - 1); };
  return sortedByKey(entries, buckets, bucketOf, threads, begin);
}

/// Sorts by x; equal ones keep their order. Quick for entries that are nearly in order, as all are but where far
/// outliers make the buckets of roughlyByX() wide.
void sortByX(Entry* begin, Entry* end) {
  std::ptrdiff_t patience = 64 * (end - begin);
  for (Entry* i = begin; i < end; ++i) {
    const Entry entry = *i;
    Entry* to = i;
    for (; to > begin && (to - 1)->x > entry.x; --to) *to = *(to - 1);
    *to = entry;
    patience -= i - to;
    if (patience < 0) return std::stable_sort(begin, end, [](const Entry& a, const Entry& b) { return a.x < b.x; });
  }
}

}  // namespace

PointGrid::PointGrid(const std::vector<Eigen::Vector3f>& points, double cell, int threads) {
  const std::size_t n = points.size();
  const Eigen::AlignedBox3f bounds = boundsOf(points, threads);
  rows_ = rowsIn(bounds, cell);
  std::vector<Entry> entries = sortedByKey(
      roughlyByX(points, bounds, rows_, threads), std::size_t(rows_.count_y) * std::size_t(rows_.count_z),
      [](const Entry& entry) { return entry.row; }, threads, rows_.begin);
  source.resize(n);
  for (auto* axis : {&x, &y, &z}) axis->resize(n + simd_padding);
  rows_.pivots.assign(n / Rows::pivot_spacing + 1 + simd_padding, std::numeric_limits<float>::infinity());
#pragma omp parallel for schedule(dynamic, 256) num_threads(threads)
  for (std::size_t r = 0; r < rows_.begin.size() - 1; ++r) {
    sortByX(entries.data() + rows_.begin[r], entries.data() + rows_.begin[r + 1]);
    for (std::uint32_t i = rows_.begin[r]; i < rows_.begin[r + 1]; ++i) {
      const Eigen::Vector3f& p = points[entries[i].source];
      source[i] = entries[i].source;
      x[i] = p.x();
      y[i] = p.y();
      z[i] = p.z();
      if (i % Rows::pivot_spacing == 0) rows_.pivots[i / Rows::pivot_spacing] = p.x();
    }
  }
  for (auto* axis : {&x, &y, &z}) std::fill(axis->begin() + n, axis->end(), std::numeric_limits<float>::infinity());
}

std::uint32_t PointGrid::findRows(std::size_t i, float radius, std::vector<Run>& rows) const {
  rows.clear();
  const std::uint32_t own = rows_.at(y[i], z[i]);
  const int j = int(own % std::uint32_t(rows_.count_y)), k = int(own / std::uint32_t(rows_.count_y));
  const int reach = int(radius * (1 + 1e-3f) / rows_.cell) + 1;  // rounding must not lose a point at the rim
  for (int kk = std::max(k - reach, 0); kk <= std::min(k + reach, rows_.count_z - 1); ++kk) {
    for (int jj = std::max(j - reach, 0); jj <= std::min(j + reach, rows_.count_y - 1); ++jj) {
      const std::size_t r = std::size_t(kk) * rows_.count_y + jj;
      if (rows_.begin[r] != rows_.begin[r + 1]) rows.push_back({rows_.begin[r], rows_.begin[r + 1]});
    }
  }
  return rows_.begin[own + 1];
}

std::vector<Eigen::Vector3f> PointGrid::positions() const {
  std::vector<Eigen::Vector3f> points(size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = point(i);
  return points;
}

}  // namespace sks
