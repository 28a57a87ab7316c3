// SPDX-License-Identifier: BSD-3-Clause
// Normals of organised clouds. Each SIMD lane is one pixel; its neighbours are read from the image, shifted by each
// offset at which a point within the radius can appear. Where only every n-th column is wanted, those n columns apart
// lie side by side, so that they are still read together.
#include "core/surface/image_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/surface/image_normals.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "core/surface/plane_moments-inl.hpp"

#ifndef SKS_IMAGE_NORMALS_ONCE
#define SKS_IMAGE_NORMALS_ONCE
namespace sks {

/// Positions by pixel, NaN where there is none, with a margin on each side.
struct PositionImage {
  std::vector<float> x, y, z;
  std::size_t step = 1;    ///< between columns that lie side by side
  std::size_t part = 0;    ///< entries of a row for columns that are `step` apart
  std::size_t margin = 0;  ///< [pixel], a multiple of `step`

  std::size_t stride() const { return step * part; }
  std::size_t at(std::size_t row, std::size_t column) const {
    const std::size_t shifted = column + margin;
    return (row + margin) * stride() + shifted % step * part + shifted / step;
  }
};

/// How far from a point another one within the radius may appear.
struct WindowSize {
  float radius;  ///< [m]
  float focal;   ///< [pixel]
  float extra;   ///< [pixel]
};

}  // namespace sks
#endif

HWY_BEFORE_NAMESPACE();
namespace sks {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Largest distance in the image at which a neighbour of one of the points may appear [pixel].
HWY_INLINE float reachOf(hn::Vec<Points> x, hn::Vec<Points> y, hn::Vec<Points> z, const WindowSize& window) {
  const Points d;
  const auto distance = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
  const auto reach = hn::Div(distance, hn::Mul(z, hn::Sub(z, hn::Set(d, window.radius))));
  const float largest = hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(hn::Eq(z, z), reach)));
  return window.focal * window.radius * largest * (1 + 1e-3f) + window.extra;
}

/// Of every `step`-th column of a row.
void rowNormalsImpl(const PositionImage& image, std::size_t row, std::size_t columns, const WindowSize& window,
                    int min_neighbors, Eigen::Vector3f* normals) {
  const Points d;
  Moments moments;
  Fits fits;
  const int step = int(image.step);
  for (std::size_t column = 0; column < columns; column += image.step * hn::Lanes(d)) {
    const std::size_t here = image.at(row, column);
    const auto x = hn::LoadU(d, &image.x[here]), y = hn::LoadU(d, &image.y[here]), z = hn::LoadU(d, &image.z[here]);
    if (hn::AllFalse(d, hn::Eq(z, z))) continue;
    const float reach = reachOf(x, y, z, window);
    MomentSums sums(x, y, z, window.radius);
    for (int down = -int(reach); down <= int(reach); ++down) {
      const int half = int(std::sqrt(reach * reach - float(down * down)));
      const std::size_t middle = std::size_t(std::ptrdiff_t(here) + down * std::ptrdiff_t(image.stride()));
      for (int part = 0; part < step; ++part) {  // columns `part` + k `step` away, from -half to half
        const std::size_t from = middle + std::size_t(part) * image.part;
        const std::size_t before = std::size_t((half + part) / step), after = std::size_t((half - part + step) / step);
        HWY_UNROLL(4)
        for (std::size_t i = from - before; i < from + after; ++i) {
          sums.add(hn::LoadU(d, &image.x[i]), hn::LoadU(d, &image.y[i]), hn::LoadU(d, &image.z[i]));
        }
      }
    }
    sums.store(moments);
    solve(moments, fits);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      if (!std::isnan(image.z[here + i])) *normals++ = normalOf(moments, fits, i, min_neighbors);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sks {

HWY_EXPORT(rowNormalsImpl);

namespace {

constexpr double max_margin = 64;  // [pixel]; nearer to the camera the grid is quicker

/// The first point of a row of the image, or of the next one that has any.
std::size_t firstOfRow(const Cloud& cloud, std::size_t row) {
  const auto first = std::lower_bound(cloud.pixels.begin(), cloud.pixels.end(), row * cloud.columns);
  return std::size_t(first - cloud.pixels.begin());
}

/// Among the points whose row and column are multiples of `step`, the first one of each such row, and their number.
void findFirstOfRows(const Cloud& cloud, std::size_t rows, std::uint32_t step, std::vector<std::size_t>& first) {
  first.assign(1, 0);
  for (std::size_t row = 0; row < rows; row += step) {
    const std::size_t end = firstOfRow(cloud, row + 1);
    std::size_t count = 0;
    for (std::size_t i = firstOfRow(cloud, row); i < end; ++i)
      count += (cloud.pixels[i] - row * cloud.columns) % step == 0;
    first.push_back(first.back() + count);
  }
}

/// Empties line `line` of the image, margins included, and puts in the points of its row.
void drawLine(const Cloud& cloud, std::size_t line, std::size_t rows, PositionImage& image) {
  for (auto* axis : {&image.x, &image.y, &image.z}) {
    std::fill_n(axis->begin() + std::ptrdiff_t(line * image.stride()), image.stride(),
                std::numeric_limits<float>::quiet_NaN());
  }
  if (line < image.margin || line >= rows + image.margin) return;
  const std::size_t row = line - image.margin, end = firstOfRow(cloud, row + 1);
  for (std::size_t i = firstOfRow(cloud, row); i < end; ++i) {
    const std::size_t at = image.at(row, cloud.pixels[i] - row * cloud.columns);
    image.x[at] = cloud.points[i].x();
    image.y[at] = cloud.points[i].y();
    image.z[at] = cloud.points[i].z();
  }
}

}  // namespace

bool imageNormals(const Cloud& cloud, const Pinhole& camera, std::uint32_t step, const SurfaceSettings& settings,
                  int threads, std::vector<Eigen::Vector3f>& normals) {
  if (camera.nearest < 2 * settings.normal_radius) return false;
  const WindowSize window{float(settings.normal_radius),
                          float(std::max(std::abs(camera.focal_x), std::abs(camera.focal_y))),
                          float(2 * camera.deviation)};
  const double margin =
      1.01 * window.focal * window.radius * camera.widest / (camera.nearest - window.radius) + window.extra;
  if (margin > max_margin) return false;

  thread_local PositionImage kept_image;  // from frame to frame; the other threads see that of this one
  PositionImage& image = kept_image;
  const std::size_t rows = cloud.pixels.back() / cloud.columns + 1;
  image.step = step;
  image.margin = (std::size_t(margin) / step + 1) * step;
  image.part = (cloud.columns + 2 * image.margin) / step + 1 + PointGrid::simd_padding;
  const std::size_t lines = rows + 2 * image.margin;
  for (auto* axis : {&image.x, &image.y, &image.z}) axis->resize(lines * image.stride());
  thread_local std::vector<std::size_t> kept_first;
  std::vector<std::size_t>& first = kept_first;
  findFirstOfRows(cloud, rows, step, first);
  const std::size_t wanted = first.size() - 1;
  normals.resize(first.back());
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(static)
    for (std::size_t line = 0; line < lines; ++line) drawLine(cloud, line, rows, image);
#pragma omp for schedule(dynamic, 4)
    for (std::size_t k = 0; k < wanted; ++k) {
      HWY_DYNAMIC_DISPATCH(rowNormalsImpl)
      (image, k * step, cloud.columns, window, settings.normal_min_neighbors, normals.data() + first[k]);
    }
  }
  return true;
}

}  // namespace sks
#endif
