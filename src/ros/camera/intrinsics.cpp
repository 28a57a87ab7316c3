// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/intrinsics.hpp"

#include <cmath>

namespace sks_detector {

Intrinsics intrinsicsFromFieldOfView(int width, int height, double horizontal, double vertical) {
  Intrinsics result;
  result.fx = horizontal > 0 ? width / (2 * std::tan(horizontal / 2)) : 525.0 * width / 640.0;
  result.fy = horizontal > 0 && vertical > 0 ? height / (2 * std::tan(vertical / 2)) : result.fx;
  result.cx = 0.5 * (width - 1);
  result.cy = 0.5 * (height - 1);
  return result;
}

Intrinsics withCalibration(Intrinsics intrinsics, double focal_length, double center_x, double center_y) {
  if (focal_length > 0) intrinsics.fx = intrinsics.fy = focal_length;
  if (center_x > 0) intrinsics.cx = center_x;
  if (center_y > 0) intrinsics.cy = center_y;
  return intrinsics;
}

}  // namespace sks_detector
