// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace sks {

/// Colour of one point, sRGB.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
};

/// A point cloud as it comes from a sensor or a file, before any preparation. Row-major if organised. One with nothing
/// but points is a whole cloud: without a width it is not organised.
struct Cloud {
  std::uint32_t width = 0;              ///< columns of an organised cloud; else the number of points, or 0
  std::uint32_t height = 1;             ///< rows; 1 if not organised
  std::vector<Eigen::Vector3f> points;  ///< positions [m], in the frame of the cloud; NaN where nothing was measured
  std::vector<Rgb> colors;              ///< empty (no colour), or one for each point
  Eigen::Vector3f sensor_origin = Eigen::Vector3f::Zero();  ///< position of the camera in the frame of the points [m]

  /// Of the points that are left of an organised cloud (sanitize()): where each was in the image, row * columns +
  /// column, ascending. Else empty.
  std::vector<std::uint32_t> pixels;
  std::uint32_t columns = 0;  ///< of that image

  std::uint32_t columnCount() const { return width > 0 ? width : std::uint32_t(points.size()); }
  std::uint32_t rowCount() const { return width > 0 ? height : 1; }
  bool organized() const { return width > 0 && height > 1; }
  bool hasColor() const { return !colors.empty(); }
  std::size_t size() const { return points.size(); }
};

}  // namespace sks
