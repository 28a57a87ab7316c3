// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

namespace sks {

/// A plane that much of a scene lies on: a table, a wall, the floor.
struct LargePlane {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
  float offset = 0;                                  ///< normal . p for points p of the plane [m]
  float extent = 0;                                  ///< the smaller one of its extents within the plane [m]

  /// Whether a point of the scene belongs to it.
  bool contains(const Eigen::Vector3f& point, const Eigen::Vector3f& point_normal) const;
};

/// The planes with the most points, by RANSAC with a fixed seed; of a scene without any: none. The same for any number
/// of threads.
std::vector<LargePlane> findLargePlanes(const Surface& scene, int threads = 1);

/// The largest extent of those planes that the point belongs to; 0 if it lies on none [m].
float planeExtentAt(const std::vector<LargePlane>& planes, const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

/// The measured keypoints that do not lie on planes of a larger extent than this [m]. Their normals may have either
/// sign.
Keypoints keypointsOffPlanes(const Keypoints& keypoints, const std::vector<LargePlane>& planes, float extent);

}  // namespace sks
