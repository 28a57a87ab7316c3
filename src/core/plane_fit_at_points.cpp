// SPDX-License-Identifier: BSD-3-Clause
// Planes at the points of a grid. Each SIMD lane is one point; a few consecutive points of a row share most of their
// neighbours, which are read once for all of them.
#include <algorithm>
#include <limits>

#include "core/plane_fit.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/plane_fit_at_points.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/smallest_eigenvector-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t max_lanes = PointGrid::simd_padding;
using Points = hn::CappedTag<float, max_lanes>;

/// Sums over the neighbours of each point, relative to it.
struct Moments {
  enum { count, x, y, z, xx, xy, xz, yy, yz, zz, size };
  float sums[size][max_lanes];
};

/// Unit normals and how well each is determined.
struct Fits {
  float x[max_lanes], y[max_lanes], z[max_lanes], certainty[max_lanes];
};

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
  const auto cx = hn::LoadU(d, &grid.x[first]), cy = hn::LoadU(d, &grid.y[first]), cz = hn::LoadU(d, &grid.z[first]);
  const auto limit = hn::Set(d, radius * radius), one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  auto n = zero, sx = zero, sy = zero, sz = zero;
  auto xx = zero, xy = zero, xz = zero, yy = zero, yz = zero, zz = zero;
  for (const PointGrid::Run window : windows) {
    for (std::size_t i = window.begin; i < window.end; ++i) {
      auto x = hn::Sub(hn::Set(d, grid.x[i]), cx);
      auto y = hn::Sub(hn::Set(d, grid.y[i]), cy);
      auto z = hn::Sub(hn::Set(d, grid.z[i]), cz);
      const auto squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
      const auto inside = hn::Le(squared, limit);
      x = hn::IfThenElseZero(inside, x);
      y = hn::IfThenElseZero(inside, y);
      z = hn::IfThenElseZero(inside, z);
      n = hn::Add(n, hn::IfThenElseZero(inside, one));
      sx = hn::Add(sx, x);
      sy = hn::Add(sy, y);
      sz = hn::Add(sz, z);
      xx = hn::MulAdd(x, x, xx);
      xy = hn::MulAdd(x, y, xy);
      xz = hn::MulAdd(x, z, xz);
      yy = hn::MulAdd(y, y, yy);
      yz = hn::MulAdd(y, z, yz);
      zz = hn::MulAdd(z, z, zz);
    }
  }
  float* out = moments.sums[0];
  for (const auto& sum : {n, sx, sy, sz, xx, xy, xz, yy, yz, zz}) {
    hn::StoreU(sum, d, out);
    out += max_lanes;
  }
}

/// Fits of `count` points from their moments, in double precision.
void solve(const Moments& moments, std::size_t count, Fits& fits) {
  const hn::CappedTag<double, max_lanes> d;
  const hn::Rebind<float, decltype(d)> df;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto load = [&](int k) { return hn::PromoteTo(d, hn::LoadU(df, &moments.sums[k][i])); };
    const auto share = hn::Div(hn::Set(d, 1.0), load(Moments::count));
    const auto mx = hn::Mul(load(Moments::x), share), my = hn::Mul(load(Moments::y), share),
               mz = hn::Mul(load(Moments::z), share);
    const auto covariance = [&](int k, auto a, auto b) { return hn::MulSub(load(k), share, hn::Mul(a, b)); };
    SymmetricMatrices<decltype(hn::Zero(d))> m;
    m.xx = covariance(Moments::xx, mx, mx);
    m.xy = covariance(Moments::xy, mx, my);
    m.xz = covariance(Moments::xz, mx, mz);
    m.yy = covariance(Moments::yy, my, my);
    m.yz = covariance(Moments::yz, my, mz);
    m.zz = covariance(Moments::zz, mz, mz);
    auto x = hn::Zero(d), y = x, z = x;
    const auto certainty = smallestEigenvectors(d, m, x, y, z);
    hn::StoreU(hn::DemoteTo(df, x), df, &fits.x[i]);
    hn::StoreU(hn::DemoteTo(df, y), df, &fits.y[i]);
    hn::StoreU(hn::DemoteTo(df, z), df, &fits.z[i]);
    hn::StoreU(hn::DemoteTo(df, certainty), df, &fits.certainty[i]);
  }
}

Eigen::Matrix3d covariance(const Moments& moments, std::size_t i) {
  const auto sum = [&](int k) { return double(moments.sums[k][i]); };
  const double n = sum(Moments::count);
  const Eigen::Vector3d mean = Eigen::Vector3d(sum(Moments::x), sum(Moments::y), sum(Moments::z)) / n;
  Eigen::Matrix3d scatter;
  scatter << sum(Moments::xx), sum(Moments::xy), sum(Moments::xz), sum(Moments::xy), sum(Moments::yy), sum(Moments::yz),
      sum(Moments::xz), sum(Moments::yz), sum(Moments::zz);
  return scatter / n - mean * mean.transpose();
}

Eigen::Vector3f normalOf(const Moments& moments, const Fits& fits, std::size_t i, int min_neighbors) {
  if (moments.sums[Moments::count][i] < float(min_neighbors)) {
    return Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  }
  if (!(fits.certainty[i] > 1e-12f)) return smallestEigenvector(covariance(moments, i));
  return {fits.x[i], fits.y[i], fits.z[i]};
}

void fitPlanesAtPointsImpl(const PointGrid& grid, std::size_t begin, std::size_t end, float radius, int min_neighbors,
                           NormalArrays normals) {
  const std::size_t lanes = hn::Lanes(Points());
  const float reach = radius * (1 + 1e-3f);  // rounding must not lose a point at the rim
  std::vector<PointGrid::Run> rows, windows;
  Moments moments;
  Fits fits;
  for (std::size_t first = begin, row_end = begin, next; first < end; first = next) {
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
    solve(moments, next - first, fits);
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
