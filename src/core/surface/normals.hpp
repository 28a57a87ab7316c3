// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Estimates and orients the normal at every point. Deterministic for any number of threads.
void estimateNormals(Surface& surface, const SurfaceSettings& settings, Orientation orientation, int threads);

/// Gives a surface the normals of the points that it was made from, turned towards the sensor.
/// @param of_source by the index of PointGrid::source
void takeNormals(Surface& surface, const std::vector<Eigen::Vector3f>& of_source, int threads);

}  // namespace sks
