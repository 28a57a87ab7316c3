// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// The normal at each point of a cloud whose points have pixels: least-squares planes as fitPlanesAtPoints() fits them,
/// not oriented, but the neighbours are looked for in a window of the image.
/// @return false, and no normals, where the pixels are not those of a pinhole camera in the cloud's frame (z ahead)
bool imageNormals(const Cloud& cloud, const SurfaceSettings& settings, int threads,
                  std::vector<Eigen::Vector3f>& normals);

}  // namespace sks
