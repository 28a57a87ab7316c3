// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/stages/keypoints.hpp>

#include "core/keypoints/iss_keypoints.hpp"
#include "core/surface/voxels.hpp"

namespace sks {

Keypoints gridKeypoints(const Surface& surface, double grid_size, int threads) {
  Keypoints keypoints;
  keypoints.positions = voxelCentroids(surface, grid_size, threads);
  return keypoints;
}

Keypoints detectKeypoints(const Surface& surface, const KeypointSettings& settings, int threads) {
  return settings.detector == KeypointDetector::iss ? issKeypoints(surface, settings, threads)
                                                    : gridKeypoints(surface, settings.grid_size, threads);
}

}  // namespace sks
