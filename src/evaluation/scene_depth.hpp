// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <sks_detector/cloud.hpp>

namespace sks {

/// A pinhole camera at the origin of its frame, z ahead: column = fx * x / z + cx, row likewise [px].
struct SceneCamera {
  int width = 0, height = 0;  ///< [px]
  double fx = 0, fy = 0, cx = 0, cy = 0;

  /// Length of the ray through a pixel up to z = 1.
  double rayLength(int column, int row) const;
};

/// Depths along z of each pixel, row-major [m]; 0 where there is none.
using DepthMap = std::vector<float>;

/// What a depth camera measured, and its pinhole model.
struct SceneDepth {
  SceneCamera camera;
  DepthMap depth;
};

/// The depth picture of an organised cloud, with the camera that its points tell of; none for other clouds and where
/// the points are not those of a pinhole camera to half a pixel.
std::optional<SceneDepth> sceneDepth(const Cloud& cloud, int threads);

}  // namespace sks
