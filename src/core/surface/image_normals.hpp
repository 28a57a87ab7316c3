// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>

#include "core/surface/pinhole_fit.hpp"

namespace sks {

/// The normals at those points of a cloud whose row and column are multiples of `step`, in their order: least-squares
/// planes of all neighbours, as fitPlanesAtPoints() fits them, not oriented, but the neighbours are looked for in a
/// window of the image.
/// @param camera that saw the cloud, of fitPinhole()
/// @param step at least 1
/// @return false, and no normals, where the cloud is so near that the windows would be too large
bool imageNormals(const Cloud& cloud, const Pinhole& camera, std::uint32_t step, const SurfaceSettings& settings,
                  int threads, std::vector<Eigen::Vector3f>& normals);

}  // namespace sks
