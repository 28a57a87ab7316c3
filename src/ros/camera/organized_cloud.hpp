// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "ros/camera/camera_frame.hpp"

namespace sks_detector {

/// A point as it lies in the message.
struct OrganizedPoint {
  float x;            ///< [m]; all three are NaN where nothing was measured
  float y;            ///< [m]
  float z;            ///< [m]
  std::uint32_t rgb;  ///< 0x00rrggbb; 0 without colour
};
static_assert(sizeof(OrganizedPoint) == 16 && std::is_trivially_copyable_v<OrganizedPoint>);

/// Writes one point for each pixel of the depth image, in the camera's optical frame. A colour image of another size is
/// taken to show the same view: each point gets the pixel at its position in proportion.
void organizedCloud(const CameraFrame& frame, OrganizedPoint* points);

}  // namespace sks_detector
