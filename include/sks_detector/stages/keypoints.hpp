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

/// Intrinsic shape signatures (Zhong 2009), by PCL.
Keypoints issKeypoints(const Surface& surface, const KeypointSettings& settings, int threads);

/// The keypoints that the settings ask for, without selection.
Keypoints detectKeypoints(const Surface& surface, const KeypointSettings& settings, int threads);

/// Fills in normals and Gaussian curvature K = kappa_1 kappa_2 of the local surface (all points within the grid size):
/// kappa_1, kappa_2 are the eigenvalues of the covariance of the neighbours' normals in the keypoint's own tangent
/// plane (section 4), so planes score 0. Keypoints without a normal score 0.
void measureCurvature(const Surface& surface, Keypoints& keypoints, const KeypointSettings& settings,
                      const SurfaceSettings& surface_settings, int threads);

/// Sparse keypoint selection (section 4) on measured keypoints; keeps their order.
/// Rank: drops exactly floor(discard * n) keypoints, of equal K those that come later in the grid's order are kept
/// by a fixed scramble of their index, so that ties do not favour one side of the scene.
Keypoints selectKeypoints(const Keypoints& keypoints, const KeypointSettings& settings);

}  // namespace sks
