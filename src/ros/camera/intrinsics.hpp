// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sks_detector {

/// Pinhole camera without distortion [px]; the middle of the first pixel is (0, 0).
struct Intrinsics {
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// A camera with the optical axis in the middle of its image and these full angles of view [rad]; without a vertical
/// one (0) its pixels are square, without any it has the 62.7 degrees (525 px at a width of 640) of the usual sensors.
Intrinsics intrinsicsFromFieldOfView(int width, int height, double horizontal, double vertical);

/// The same with what the user knows better [px]: 0 keeps a value.
Intrinsics withCalibration(Intrinsics intrinsics, double focal_length, double center_x, double center_y);

}  // namespace sks_detector
