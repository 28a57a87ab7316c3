// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>

namespace sks {

/// What objects stand on, like the top of a table: the part of a plane that a cloud shows.
struct Support {
  /// The middle of the smallest rectangle around it, in the frame of the cloud: z is the plane's normal to the side of
  /// the camera (up, for a table that is seen from above), x is along the longer side.
  Eigen::Isometry3d T_scene_plane = Eigen::Isometry3d::Identity();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< full extents of that rectangle along x and y [m]
  /// Corners of the convex hull, x and y in the plane's own frame, counter-clockwise as seen from +z [m].
  std::vector<Eigen::Vector2d> outline;
  std::size_t standing = 0;  ///< detections that stand on it
};

/// Finds the plane that most of the detections stand on; where none stands on any, the largest. Planes are sought by
/// RANSAC in points thinned to an even density, first around the detections; none is smaller than 0.04 m^2.
/// Deterministic, and safe to call from several threads.
/// @param cloud in metres, in any frame, with its sensor_origin; points that `settings` leave out do not count
/// @param detections in the frame of the cloud, of a score that counts
/// @return nothing where there is no plane, or no usable cloud
std::optional<Support> findSupport(const Cloud& cloud, const std::vector<Detection>& detections,
                                   const SanitizeSettings& settings = {});

}  // namespace sks
