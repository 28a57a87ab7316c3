// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace sks {

/// Convex hull of points in a plane.
class ConvexPolygon {
public:
  explicit ConvexPolygon(std::vector<Eigen::Vector2f> points);

  /// Distance of a point inside to the nearest edge; negative outside, also where the points span no area.
  float depth(const Eigen::Vector2f& point) const;
  float area() const;

  /// Counter-clockwise.
  const std::vector<Eigen::Vector2f>& corners() const { return corners_; }

private:
  std::vector<Eigen::Vector2f> corners_;
};

}  // namespace sks
