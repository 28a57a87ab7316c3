// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

namespace sks {

/// The part of a cloud in the direction of a box.
struct ObjectCrop {
  Cloud cloud;     ///< organised if the whole is; without points where the sensor saw nothing there
  int stride = 1;  ///< every so many rows and columns were taken
};

/// All that the sensor saw in front of a box, in it and behind it: what tells whether the object is there, hidden or
/// gone.
/// @param T_cloud_box pose of the box; its centre is the origin
/// @param half_size of the box with a margin around it, along its axes [m]
/// @param spacing rows and columns are left out as long as points lie no farther apart at the box [m]
ObjectCrop cropAround(const Cloud& cloud, const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& half_size,
                      double spacing);

}  // namespace sks
