// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sks_detector/cloud.hpp>

namespace sks {

/// A camera in the frame of a cloud, z ahead: column = focal_x * x / z + center_x, row likewise [pixel].
struct Pinhole {
  double focal_x = 0, center_x = 0;
  double focal_y = 0, center_y = 0;
  double deviation = 0;  ///< of the worst point of the cloud
  double nearest = 0;    ///< smallest z of the cloud [m]
  double widest = 0;     ///< largest distance from the camera, in units of z
};

/// The camera that saw the points of a cloud at their pixels, by least squares; none where points lie behind it, or
/// deviate by more than half a pixel.
std::optional<Pinhole> fitPinhole(const Cloud& cloud, int threads);

}  // namespace sks
