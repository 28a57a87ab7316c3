// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/surface.hpp>

#include <algorithm>
#include <cmath>

#include "core/orientation.hpp"
#include "core/plane_fit.hpp"

namespace sks {

void estimateNormals(Surface& surface, const SurfaceSettings& settings, Orientation orientation, int threads) {
  const std::size_t n = surface.size();
  surface.orientation = orientation;
  for (auto* axis : {&surface.nx, &surface.ny, &surface.nz}) axis->assign(n + PointGrid::simd_padding, 0.0f);
  constexpr std::size_t chunk = 512;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t begin = 0; begin < n; begin += chunk) {
    Eigen::Vector3f normals[chunk];
    const std::size_t count = std::min(chunk, n - begin);
    fitPlanesAtPoints(surface, begin, begin + count, float(settings.normal_radius), settings.normal_min_neighbors,
                      normals);
    for (std::size_t i = 0; i < count; ++i) {
      const float side = normals[i].dot(surface.sensor_origin - surface.point(begin + i)) < 0 ? -1.0f : 1.0f;
      surface.nx[begin + i] = side * normals[i].x();
      surface.ny[begin + i] = side * normals[i].y();
      surface.nz[begin + i] = side * normals[i].z();
    }
  }
  if (orientation == Orientation::outward) orientOutward(surface, threads);
}

Surface prepareSurface(const Cloud& sanitized, const SurfaceSettings& settings, Orientation orientation, int threads) {
  Surface surface = settings.resolution > 0 ? makeSurface(thin(sanitized, settings.resolution), settings.normal_radius)
                                            : makeSurface(sanitized, settings.normal_radius);
  estimateNormals(surface, settings, orientation, threads);
  return surface;
}

}  // namespace sks
