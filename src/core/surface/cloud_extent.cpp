// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/cloud_extent.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"

namespace sks {
namespace {

constexpr double nearest_scene = 0.05;  // [m] no RGB-D sensor measures so near

/// Farthest of the points from the sensor [m].
double reachOf(const Cloud& cloud) {
  float squared = 0;
  for (const Eigen::Vector3f& point : cloud.points) {
    squared = std::max(squared, (point - cloud.sensor_origin).squaredNorm());
  }
  return std::sqrt(double(squared));
}

}  // namespace

void checkExtent(const Cloud& cloud, Orientation orientation, const Settings& settings) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : cloud.points) box.extend(point);
  if (box.isEmpty()) return;
  const Eigen::Vector3d size = box.sizes().cast<double>();
  const double largest = size.maxCoeff(), normal_radius = settings.surface.normal_radius;
  const bool at_sensor =
      orientation == Orientation::sensor && largest < settings.descriptor.radius && reachOf(cloud) < nearest_scene;
  if (largest >= normal_radius && !at_sensor) return;
  throw Error(
      ErrorCode::bad_data,
      formatted("the cloud is too small: it is %.3g x %.3g x %.3g mm large, and surface.normal_radius is %.3g mm; "
                "if it is in metres already, do not scale it to metres again (units: m in a data set file, no "
                "--scale); if it is really that small, lower surface.normal_radius and descriptor.radius",
                1000 * size.x(), 1000 * size.y(), 1000 * size.z(), 1000 * normal_radius));
}

}  // namespace sks
