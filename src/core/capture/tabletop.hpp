// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

namespace sks {

/// What counts as a plane and as an object that stands on it.
struct TabletopSettings {
  double plane_tolerance = 0.01;  ///< farthest that points of a plane lie from it [m]
  double min_area = 0.04;         ///< smaller planes are none [m^2]: a square of 0.2 m; arms show less
  double min_height = 0.005;      ///< what rises less is the plane's noise, and at least three standard deviations [m]
  double max_height = 0.5;        ///< what rises more is cut off [m]
  double max_extent = 0.6;        ///< what is wider is furniture or a wall, no object [m]
  double gap = 0.02;              ///< things nearer to each other than this are one object [m]
  int min_points = 50;            ///< of an object
  double min_share = 0.01;        ///< of the largest object's points; what is smaller are stray points of the sensor
};

/// The dominant plane of a cloud and what stands on it.
struct Tabletop {
  Eigen::Hyperplane<float, 3> plane;  ///< its normal points to the side of the camera
  double area = 0;                    ///< of the plane, as far as it is seen [m^2]
  double lift = 0;                    ///< height above the plane from which points are the objects' [m]
  /// Points of each object, ascending indices into the cloud; largest object first.
  std::vector<std::vector<std::uint32_t>> objects;
};

/// Tabletop segmentation: the largest plane (RANSAC on points thinned to an even density), and above the convex hull
/// of what is seen of it clusters of points that reach down to it and do not go on beyond it. Where nothing stands on
/// the largest plane (a wall), others of at least a quarter of its area are tried; curved surfaces are none.
/// Deterministic.
/// @param cloud in its camera's frame or with its sensor origin set; NaN points are skipped
/// @throws Error(bad_data) if there is no plane
Tabletop findTabletop(const Cloud& cloud, const TabletopSettings& settings = {});

/// These points of a cloud alone: of an organised cloud the smallest window that holds them, the rest of it NaN.
/// @param points ascending indices, at least one
Cloud cutOut(const Cloud& cloud, const std::vector<std::uint32_t>& points);

}  // namespace sks
