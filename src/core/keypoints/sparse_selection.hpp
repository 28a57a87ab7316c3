// SPDX-License-Identifier: BSD-3-Clause
// Sparse keypoint selection (section 4): keypoints are ranked by the Gaussian curvature of their local surface.
#pragma once

#include <sks_detector/settings.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

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
