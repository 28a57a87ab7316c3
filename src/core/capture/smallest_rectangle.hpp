// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/capture/convex_polygon.hpp"

namespace sks {

/// A rectangle in a plane.
struct Rectangle {
  Eigen::Vector2f center = Eigen::Vector2f::Zero();      ///< [m]
  Eigen::Vector2f long_axis = Eigen::Vector2f::UnitX();  ///< unit, of either sign
  float length = 0, width = 0;                           ///< full extents along it, and across [m]
};

/// The rectangle of the least area around a polygon with an area: one of its sides lies along an edge of the polygon.
Rectangle smallestRectangle(const ConvexPolygon& polygon);

}  // namespace sks
