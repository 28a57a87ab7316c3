// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/descriptors/neighborhood.hpp"

namespace sks {

/// Where each neighbour falls in SHOT's spherical support. The 32 volumes are numbered
/// 4 * azimuth sector (0 to 7, from -pi) + 2 * outer husk + upper half. Structure of arrays.
struct ShotSupport {
  std::vector<std::int32_t> volume;
  std::vector<float> azimuth;    ///< offset from the middle of the sector, in sectors: -0.5 to 0.5
  std::vector<float> husk;       ///< offset from the middle of the husk, in husks: -0.5 to 0.5
  std::vector<float> elevation;  ///< offset of the polar angle from the middle of the half, in halves: -0.5 to 0.5
  std::vector<float> cosine;     ///< of the neighbour's normal with the z axis; NaN without a normal

  /// SIMD, runtime dispatch. `frame` has the axes as rows.
  void locate(const Neighborhood& neighborhood, const Eigen::Matrix3f& frame, float radius);
};

}  // namespace sks
