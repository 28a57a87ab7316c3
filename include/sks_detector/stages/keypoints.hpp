// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// Keypoints of a surface, ordered by grid cell.
struct Keypoints {
  std::vector<Eigen::Vector3f> positions;  ///< [m]
  std::vector<Eigen::Vector3f> normals;    ///< own normal at each position; empty before selection
  std::vector<float> curvature;            ///< Gaussian curvature K >= 0 of each; empty before selection

  std::size_t size() const { return positions.size(); }
};

/// The centroid of the points of each occupied cell of a voxel grid (section 3.1); the grid is anchored at the frame's
/// origin. Deterministic, for any number of threads.
Keypoints gridKeypoints(const Surface& surface, double grid_size, int threads = 1);

/// The keypoints that the settings ask for, without selection.
Keypoints detectKeypoints(const Surface& surface, const KeypointSettings& settings, int threads);

}  // namespace sks
