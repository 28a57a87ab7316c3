// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/surface.hpp>

#include <algorithm>

#include "core/surface/color_space.hpp"
#include "core/surface/normals.hpp"
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
  const double cell = cell_margin * settings.normal_radius;
  const bool thins = settings.resolution > 0;
  Surface surface = thins ? makeSurface(thin(sanitized, settings.resolution, threads), cell, threads)
                          : makeSurface(sanitized, cell, threads);
  const bool may_be_image = orientation == Orientation::sensor && !thins;
  if (!may_be_image || !takeImageNormals(surface, sanitized, settings, threads)) {
    estimateNormals(surface, settings, orientation, threads);
  }
  return surface;
}

}  // namespace sks
