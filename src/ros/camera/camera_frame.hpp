// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ros/camera/intrinsics.hpp"

namespace sks_detector {

struct DepthImage {
  int width = 0;
  int height = 0;
  std::uint64_t time = 0;             ///< of the device's clock [us]
  std::vector<std::uint16_t> pixels;  ///< [mm] along the optical axis, row by row; 0: nothing was measured
};

struct ColorImage {
  int width = 0;
  int height = 0;
  std::uint64_t time = 0;            ///< of the device's clock [us]
  std::vector<std::uint8_t> pixels;  ///< red, green, blue, row by row
};

/// What the camera saw at one moment. Columns run from left to right as the camera sees them: not mirrored.
struct CameraFrame {
  DepthImage depth;
  ColorImage color;       ///< empty where the device has none
  Intrinsics intrinsics;  ///< of the depth image
};

}  // namespace sks_detector
