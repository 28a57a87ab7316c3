// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/smallest_rectangle.hpp"

#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace sks {

Rectangle smallestRectangle(const ConvexPolygon& polygon) {
  const auto& corners = polygon.corners();
  Rectangle smallest;
  float least_area = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2f along = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
    const Eigen::Vector2f across(-along.y(), along.x());
    Eigen::AlignedBox2f box;
    for (const Eigen::Vector2f& corner : corners) box.extend(Eigen::Vector2f(along.dot(corner), across.dot(corner)));
    if (!(box.volume() < least_area)) continue;
    least_area = box.volume();
    const Eigen::Vector2f center = box.center().x() * along + box.center().y() * across;
    smallest = {center, along, box.sizes().x(), box.sizes().y()};
    if (smallest.length < smallest.width) {
      smallest.long_axis = across;
      std::swap(smallest.length, smallest.width);
    }
  }
  return smallest;
}

}  // namespace sks
