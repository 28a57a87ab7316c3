// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/verification/range_image.hpp"

namespace sks {

/// What a sensor saw of an object that was cut out of its picture: each part of the object lies behind or in front of
/// what was measured, never beside it. Immutable once built; thread-safe.
class ViewSilhouette {
public:
  ViewSilhouette() = default;
  /// @param image of the object alone
  explicit ViewSilhouette(const RangeImage& image);

  /// Whether a position appears farther than `margin` [m] from all that was measured. What the sensor lost inside of
  /// the object, as far as it is narrower than twice the margin, is no outside.
  bool isOutside(const Eigen::Vector3f& position, float margin) const;

  /// The way [m], across the direction of view, by which a position has to move to appear where something was measured;
  /// zero where it does.
  Eigen::Vector3f wayInside(const Eigen::Vector3f& position) const;

private:
  float distanceAt(float column, float row) const;

  RangeImage::Projection projection_;
  int width_ = 0, height_ = 0;           // in cells, with a frame of `widest` cells around the image
  std::vector<std::uint8_t> distances_;  // to the nearest measured cell [cells]
};

}  // namespace sks
