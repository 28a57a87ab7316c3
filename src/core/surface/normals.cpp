// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/normals.hpp"

#include <algorithm>
#include <cmath>

#include "core/surface/orientation.hpp"
#include "core/surface/plane_fit.hpp"

namespace sks {
namespace {

/// Turns the normals of points `begin` to `end` - 1 towards the sensor.
void faceSensor(Surface& surface, std::size_t begin, std::size_t end) {
  const Eigen::Vector3f& o = surface.sensor_origin;
  for (std::size_t i = begin; i < end; ++i) {
    const float towards = surface.nx[i] * (o.x() - surface.x[i]) + surface.ny[i] * (o.y() - surface.y[i]) +
                          surface.nz[i] * (o.z() - surface.z[i]);
    const float side = towards < 0 ? -1.0f : 1.0f;
    surface.nx[i] *= side;
    surface.ny[i] *= side;
    surface.nz[i] *= side;
  }
}

}  // namespace

void estimateNormals(Surface& surface, const SurfaceSettings& settings, Orientation orientation, int threads) {
  const std::size_t n = surface.size();
  surface.orientation = orientation;
  for (auto* axis : {&surface.nx, &surface.ny, &surface.nz}) axis->assign(n + PointGrid::simd_padding, 0.0f);
  constexpr std::size_t chunk = 512;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t begin = 0; begin < n; begin += chunk) {
    const std::size_t end = std::min(begin + chunk, n);
    fitPlanesAtPoints(surface, begin, end, float(settings.normal_radius), settings.normal_min_neighbors,
                      {surface.nx.data(), surface.ny.data(), surface.nz.data()});
    faceSensor(surface, begin, end);
  }
  if (orientation == Orientation::outward) orientOutward(surface, threads);
}

void takeNormals(Surface& surface, const std::vector<Eigen::Vector3f>& of_source, int threads) {
  const std::size_t n = surface.size();
  surface.orientation = Orientation::sensor;
  for (auto* axis : {&surface.nx, &surface.ny, &surface.nz}) axis->assign(n + PointGrid::simd_padding, 0.0f);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3f& normal = of_source[surface.source[i]];
    surface.nx[i] = normal.x();
    surface.ny[i] = normal.y();
    surface.nz[i] = normal.z();
  }
  faceSensor(surface, 0, n);
}

}  // namespace sks
