// SPDX-License-Identifier: BSD-3-Clause
// PointGrid::findRuns(). In each row the ends of a run are found by comparing a vector of pivots, every 16th point,
// and then a vector of points: two loads that wait for each other, where a binary search has seven.
#include <sks_detector/stages/point_grid.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/surface/point_grid_runs.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Values = hn::CappedTag<float, PointGrid::simd_padding>;

/// First of the ascending `values`[begin, end) that is not below `limit`, else `end`; reads on beyond `end`.
HWY_INLINE std::uint32_t firstNotBelow(const float* values, std::uint32_t begin, std::uint32_t end, float limit) {
  const Values d;
  for (std::uint32_t i = begin; i < end; i += std::uint32_t(hn::Lanes(d))) {
    const auto found = hn::FindFirstTrue(d, hn::Ge(hn::LoadU(d, values + i), hn::Set(d, limit)));
    if (found >= 0) return std::min(i + std::uint32_t(found), end);
  }
  return end;
}

/// The same of the x of points, by their pivots.
HWY_INLINE std::uint32_t firstInRow(const float* x, const float* pivots, std::uint32_t begin, std::uint32_t end,
                                    float limit) {
  constexpr std::uint32_t spacing = PointGrid::Rows::pivot_spacing;
  const std::uint32_t first = (begin + spacing - 1) / spacing, last = (end + spacing - 1) / spacing;
  const std::uint32_t pivot = firstNotBelow(pivots, first, last, limit);
  return firstNotBelow(x, pivot > first ? (pivot - 1) * spacing : begin, std::min(pivot * spacing, end), limit);
}

void findRunsImpl(const PointGrid::Rows& rows, const float* x, const float* center, float radius,
                  std::vector<PointGrid::Run>& runs) {
  const float gap_y = center[1] - rows.origin_y, gap_z = center[2] - rows.origin_z;
  const auto row = [&](float gap, int count) { return int(std::clamp(gap / rows.cell, 0.0f, float(count - 1))); };
  const auto outside = [&](float gap, int index) {  // distance from the centre to the slab of row `index`
    return std::max({float(index) * rows.cell - gap, gap - float(index + 1) * rows.cell, 0.0f});
  };
  const int y0 = row(gap_y - radius, rows.count_y), y1 = row(gap_y + radius, rows.count_y);
  const int z0 = row(gap_z - radius, rows.count_z), z1 = row(gap_z + radius, rows.count_z);
  const float slack = radius * 1e-3f;  // rounding must not lose a point at the rim
  const float reach = (radius + slack) * (radius + slack);
  for (int k = z0; k <= z1; ++k) {
    const float dz = outside(gap_z, k), rest_z = reach - dz * dz;
    const std::uint32_t* row_begin = rows.begin.data() + std::size_t(k) * std::size_t(rows.count_y);
    for (int j = y0; j <= y1; ++j) {
      const std::uint32_t begin = row_begin[j], end = row_begin[j + 1];
      if (begin == end) continue;
      const float dy = outside(gap_y, j), rest = rest_z - dy * dy;
      if (rest < 0) continue;
      const float half = std::sqrt(rest) + slack;
      const std::uint32_t first = firstInRow(x, rows.pivots.data(), begin, end, center[0] - half);
      const std::uint32_t last = firstInRow(x, rows.pivots.data(), first, end, center[0] + half);
      if (first != last) runs.push_back({first, last});
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(findRunsImpl);

void PointGrid::findRuns(const Eigen::Vector3f& center, float radius, std::vector<Run>& runs) const {
  runs.clear();
  if (size() > 0) HWY_DYNAMIC_DISPATCH(findRunsImpl)(rows_, x.data(), center.data(), radius, runs);
}

}  // namespace sks
#endif
