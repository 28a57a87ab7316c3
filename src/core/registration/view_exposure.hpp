// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/cloud.hpp>

namespace sks {

/// A colour that a view saw of a place on the object.
struct SeenColor {
  std::uint32_t place = 0, view = 0;
  Rgb color;
};

/// Factors of red, green and blue, a row for each view, by which views have the same colours where they saw the same
/// places: a camera sets exposure and white balance anew for each picture. Least squares of logarithms; their mean over
/// the views is 1. What is black or clipped tells nothing. Views that share no places keep their colours.
/// @param seen ordered by place
std::vector<Eigen::Array3f> exposureFactors(const std::vector<SeenColor>& seen, std::size_t views);

/// A colour times factors, clipped.
Rgb exposed(const Rgb& color, const Eigen::Array3f& factors);

}  // namespace sks
