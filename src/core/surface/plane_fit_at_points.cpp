// SPDX-License-Identifier: BSD-3-Clause
// Planes at the points of a grid. Each SIMD lane is one point; a few consecutive points of a row share most of their
// neighbours, which are read once for all of them.
#include <algorithm>

#include "core/surface/plane_fit.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/surface/plane_fit_at_points.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/surface/plane_moments-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Moves the window of a row on to the points between `low` and `high` in x.
HWY_INLINE void slide(const float* x, float low, float high, PointGrid::Run row, PointGrid::Run& window) {
  const Points d;
  const auto advance = [&](std::uint32_t& i, auto reached) {
    while (i < row.end) {
      const auto first = hn::FindFirstTrue(d, reached(hn::LoadU(d, x + i)));
      i += first < 0 ? std::uint32_t(hn::Lanes(d)) : std::uint32_t(first);
      if (first >= 0) break;
    }
    i = i < row.end ? i : row.end;
  };
  const auto lowest = hn::Set(d, low), highest = hn::Set(d, high);
  advance(window.begin, [&](auto v) { return hn::Ge(v, lowest); });
  if (window.end < window.begin) window.end = window.begin;
  advance(window.end, [&](auto v) { return hn::Gt(v, highest); });
}

/// Moments of a vector of points from `first` on.
void sumMoments(const PointGrid& grid, std::size_t first, float radius, const std::vector<PointGrid::Run>& windows,
                Moments& moments) {
  const Points d;
  MomentSums sums(hn::LoadU(d, &grid.x[first]), hn::LoadU(d, &grid.y[first]), hn::LoadU(d, &grid.z[first]), radius);
  for (const PointGrid::Run window : windows) {
    for (std::size_t i = window.begin; i < window.end; ++i) {
      sums.add(hn::Set(d, grid.x[i]), hn::Set(d, grid.y[i]), hn::Set(d, grid.z[i]));
    }
  }
  sums.store(moments);
}

void fitPlanesAtPointsImpl(const PointGrid& grid, std::size_t begin, std::size_t end, float radius, int min_neighbors,
                           NormalArrays normals) {
  const std::size_t lanes = hn::Lanes(Points());
  const float reach = radius * (1 + 1e-3f);                // rounding must not lose a point at the rim
  thread_local std::vector<PointGrid::Run> rows, windows;  // kept from frame to frame
  Moments moments;
  Fits fits;
  for (std::size_t first = begin, row_end = begin, next = begin; first < end; first = next) {
    if (first == row_end) {
      row_end = grid.findRows(first, radius, rows);
      windows.clear();
      for (const PointGrid::Run& row : rows) windows.push_back({row.begin, row.begin});
    }
    next = std::min({first + lanes, row_end, end});
    for (std::size_t r = 0; r < rows.size(); ++r) {
      slide(grid.x.data(), grid.x[first] - reach, grid.x[next - 1] + reach, rows[r], windows[r]);
    }
    sumMoments(grid, first, radius, windows, moments);
    solve(moments, fits);
    for (std::size_t i = 0; i < next - first; ++i) {
      const Eigen::Vector3f normal = normalOf(moments, fits, i, min_neighbors);
      normals.x[first + i] = normal.x();
      normals.y[first + i] = normal.y();
      normals.z[first + i] = normal.z();
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(fitPlanesAtPointsImpl);

void fitPlanesAtPoints(const PointGrid& grid, std::size_t begin, std::size_t end, float radius, int min_neighbors,
                       NormalArrays normals) {
  HWY_DYNAMIC_DISPATCH(fitPlanesAtPointsImpl)(grid, begin, end, radius, min_neighbors, normals);
}

}  // namespace sks
#endif
