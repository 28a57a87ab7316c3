// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/stages/surface.hpp>

namespace sks {

/// The support of one descriptor, gathered once and read by local reference frame and histogram. Structure of arrays;
/// the arrays are longer than `size` and are reused from keypoint to keypoint.
struct Neighborhood {
  std::size_t size = 0;
  std::vector<float> x, y, z;        ///< relative to the keypoint [m]
  std::vector<float> distance;       ///< [m]
  std::vector<float> nx, ny, nz;     ///< normals; NaN where the surface has none
  std::vector<std::uint32_t> index;  ///< of the points in the surface
  std::vector<PointGrid::Run> runs;

  /// Replaces the content by the points within `radius` of `center`, in order of their index. SIMD, runtime dispatch.
  void gather(const Surface& surface, const Eigen::Vector3f& center, float radius);

  /// Drops the points whose normal has a cosine below `min_cosine` with the mean normal of those within `core_radius`;
  /// points without a normal too.
  void keepFacing(float min_cosine, float core_radius);
};

}  // namespace sks
