// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/surface.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/surface/color_space.hpp"
#include "core/surface/image_normals.hpp"
#include "core/surface/normals.hpp"
#include "core/surface/pinhole_fit.hpp"
#include "core/surface/voxels.hpp"

namespace sks {
namespace {

constexpr double cell_margin = 1.01;  // a cell a little larger than the radius has its neighbours in 3 x 3 rows

/// Of the points of each occupied cube the index of the one nearest to their centroid.
std::vector<std::uint32_t> nearestToCentroids(const std::vector<Eigen::Vector3f>& points, double edge, int threads) {
  const VoxelGroups voxels = groupByVoxel(points, edge, threads);
  std::vector<std::uint32_t> nearest(voxels.centroids.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    const auto distance = [&](std::uint32_t i) { return (points[i] - voxels.centroids[v]).squaredNorm(); };
    nearest[v] = *std::min_element(voxels.points.begin() + voxels.begin[v], voxels.points.begin() + voxels.begin[v + 1],
                                   [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  }
  return nearest;
}

double cellFor(const SurfaceSettings& settings) {
  return cell_margin * settings.normal_radius;
}

/// The range within which the nearest tenth of a cloud lies [m], of a sample of its points.
double nearRange(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& sensor) {
  constexpr std::size_t samples = 1000;
  std::vector<float> ranges;
  for (std::size_t i = 0; i < points.size(); i += points.size() / samples + 1) {
    ranges.push_back((points[i] - sensor).norm());
  }
  if (ranges.empty()) return 0;
  const auto tenth = ranges.begin() + std::ptrdiff_t(ranges.size() / 10);
  std::nth_element(ranges.begin(), tenth, ranges.end());
  return double(*tenth);
}

/// Whether most points of an image have their neighbour in the next column: every n-th pixel then holds every n-th
/// point. Not so where an image was enlarged, or has the pixels of another camera.
bool isDense(const Cloud& image) {
  std::size_t neighbors = 0;
  for (std::size_t i = 1; i < image.pixels.size(); ++i) neighbors += image.pixels[i] - image.pixels[i - 1] == 1;
  return 2 * neighbors > image.pixels.size();
}

/// Between measurements that are kept, in their spacing. @param spacing of the sensor [rad]
std::uint32_t stepFor(const Cloud& scene, double spacing, const SurfaceSettings& settings) {
  constexpr double least_range = 1, longest = 64;  // [m], measurements
  const double apart = spacing * std::max(least_range, nearRange(scene.points, scene.sensor_origin));
  return apart > 0 ? std::uint32_t(std::clamp(std::round(settings.spacing_at_1m / apart), 1.0, longest)) : 1;
}

/// The points whose row and column in the image are multiples of `step`.
Cloud everyPixel(const Cloud& cloud, std::uint32_t step) {
  Cloud kept;
  kept.sensor_origin = cloud.sensor_origin;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t row = cloud.pixels[i] / cloud.columns, column = cloud.pixels[i] - row * cloud.columns;
    if (row % step != 0 || column % step != 0) continue;
    kept.points.push_back(cloud.points[i]);
    if (cloud.hasColor()) kept.colors.push_back(cloud.colors[i]);
  }
  kept.width = std::uint32_t(kept.size());
  return kept;
}

/// Of a cloud that is the image of a pinhole camera, or else none.
/// @param thins as prepareScene(); else every pixel is kept
std::optional<Surface> surfaceOfImage(const Cloud& sanitized, const SurfaceSettings& settings, bool thins,
                                      int threads) {
  const std::optional<Pinhole> camera = fitPinhole(sanitized, threads);
  if (!camera) return std::nullopt;
  const double focal = std::max(std::abs(camera->focal_x), std::abs(camera->focal_y));
  const std::uint32_t step = thins && isDense(sanitized) ? stepFor(sanitized, 1 / focal, settings) : 1;
  std::vector<Eigen::Vector3f> normals;
  if (!imageNormals(sanitized, *camera, step, settings, threads, normals)) return std::nullopt;
  Surface surface = makeSurface(step > 1 ? everyPixel(sanitized, step) : sanitized, cellFor(settings), threads);
  takeNormals(surface, normals, threads);
  surface.step = float(step);
  return surface;
}

}  // namespace

Surface makeSurface(const Cloud& cloud, double cell, int threads) {
  Surface surface(cloud.points, cell, threads);
  surface.sensor_origin = cloud.sensor_origin;
  if (cloud.hasColor()) {
    surface.color.resize(surface.size());
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t i = 0; i < surface.size(); ++i) surface.color[i] = toScaledLab(cloud.colors[surface.source[i]]);
  }
  return surface;
}

Cloud thin(const Cloud& cloud, double edge, int threads) {
  Cloud thinned;
  thinned.sensor_origin = cloud.sensor_origin;
  for (const std::uint32_t i : nearestToCentroids(cloud.points, edge, threads)) {
    thinned.points.push_back(cloud.points[i]);
    if (cloud.hasColor()) thinned.colors.push_back(cloud.colors[i]);
  }
  thinned.width = std::uint32_t(thinned.size());
  return thinned;
}

std::vector<std::uint32_t> thinnedIndices(const PointGrid& points, double edge) {
  return nearestToCentroids(points.positions(), edge, 1);
}

Surface prepareSurface(const Cloud& sanitized, const SurfaceSettings& settings, Orientation orientation, int threads) {
  const bool thins = settings.resolution > 0;
  if (orientation == Orientation::sensor && !thins) {
    if (auto surface = surfaceOfImage(sanitized, settings, false, threads)) return std::move(*surface);
  }
  Surface surface =
      makeSurface(thins ? thin(sanitized, settings.resolution, threads) : sanitized, cellFor(settings), threads);
  estimateNormals(surface, settings, orientation, threads);
  return surface;
}

Surface prepareScene(const Cloud& sanitized, const SurfaceSettings& settings, int threads) {
  if (settings.resolution == 0 && settings.spacing_at_1m > 0) {
    if (auto surface = surfaceOfImage(sanitized, settings, true, threads)) return std::move(*surface);
  }
  return prepareSurface(sanitized, settings, Orientation::sensor, threads);
}

}  // namespace sks
