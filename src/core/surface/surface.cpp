// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/surface.hpp>

#include <algorithm>

#include "core/surface/color_space.hpp"
#include "core/surface/voxels.hpp"

namespace sks {

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

namespace {

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

}  // namespace sks
