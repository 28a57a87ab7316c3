// SPDX-License-Identifier: BSD-3-Clause
// Normals of organised clouds. Each SIMD lane is one pixel; its neighbours are read from the image, shifted by each
// offset at which a point within the radius can appear.
#include "core/surface/image_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/surface/pinhole_fit.hpp"

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
  std::size_t stride = 0;
  std::size_t margin = 0;

  std::size_t at(std::size_t row, std::size_t column) const { return (row + margin) * stride + column + margin; }
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

void rowNormalsImpl(const PositionImage& image, std::size_t row, std::size_t columns, const WindowSize& window,
                    int min_neighbors, Eigen::Vector3f* normals) {
  const Points d;
  Moments moments;
  Fits fits;
  for (std::size_t column = 0; column < columns; column += hn::Lanes(d)) {
    const std::size_t here = image.at(row, column);
    const auto x = hn::LoadU(d, &image.x[here]), y = hn::LoadU(d, &image.y[here]), z = hn::LoadU(d, &image.z[here]);
    if (hn::AllFalse(d, hn::Eq(z, z))) continue;
    const float reach = reachOf(x, y, z, window);
    MomentSums sums(x, y, z, window.radius);
    for (int down = -int(reach); down <= int(reach); ++down) {
      const int half = int(std::sqrt(reach * reach - float(down * down)));
      const std::size_t middle = std::size_t(std::ptrdiff_t(here) + down * std::ptrdiff_t(image.stride));
      HWY_UNROLL(4)
      for (std::size_t i = middle - std::size_t(half); i <= middle + std::size_t(half); ++i) {
        sums.add(hn::LoadU(d, &image.x[i]), hn::LoadU(d, &image.y[i]), hn::LoadU(d, &image.z[i]));
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

/// Empties line `line` of the image, margins included, and puts in the points of its row.
void drawLine(const Cloud& cloud, std::size_t line, std::size_t rows, PositionImage& image) {
  for (auto* axis : {&image.x, &image.y, &image.z}) {
    std::fill_n(axis->begin() + std::ptrdiff_t(line * image.stride), image.stride,
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

bool imageNormals(const Cloud& cloud, const SurfaceSettings& settings, int threads,
                  std::vector<Eigen::Vector3f>& normals) {
  const auto camera = fitPinhole(cloud, threads);
  if (!camera || camera->nearest < 2 * settings.normal_radius) return false;
  const WindowSize window{float(settings.normal_radius),
                          float(std::max(std::abs(camera->focal_x), std::abs(camera->focal_y))),
                          float(2 * camera->deviation)};
  const double margin =
      1.01 * window.focal * window.radius * camera->widest / (camera->nearest - window.radius) + window.extra;
  if (margin > max_margin) return false;

  thread_local PositionImage kept_image;  // from frame to frame; the other threads see that of this one
  PositionImage& image = kept_image;
  const std::size_t rows = cloud.pixels.back() / cloud.columns + 1;
  image.margin = std::size_t(margin) + 1;
  image.stride = cloud.columns + 2 * image.margin + PointGrid::simd_padding;
  const std::size_t lines = rows + 2 * image.margin;
  for (auto* axis : {&image.x, &image.y, &image.z}) axis->resize(lines * image.stride);
  normals.resize(cloud.size());
#pragma omp parallel num_threads(threads)
  {
#pragma omp for schedule(static)
    for (std::size_t line = 0; line < lines; ++line) drawLine(cloud, line, rows, image);
#pragma omp for schedule(dynamic, 4)
    for (std::size_t row = 0; row < rows; ++row) {
      HWY_DYNAMIC_DISPATCH(rowNormalsImpl)
      (image, row, cloud.columns, window, settings.normal_min_neighbors, normals.data() + firstOfRow(cloud, row));
    }
  }
  return true;
}

}  // namespace sks
#endif
