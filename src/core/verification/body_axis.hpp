// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace sks {

/// The axis about which most of a surface falls on itself when it is rotated: that of a mug without its handle, of a
/// bottle or a pitcher. A handle makes the box neither square nor centred there.
struct BodyAxis {
  int direction = 2;                                 ///< along which axis of the model frame: 0, 1 or 2
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< a point on it [m], model frame
};

/// All normals of a surface of revolution meet its axis (Pottmann and Randrup 1998). Of the lines along the axes of the
/// model frame, that which most normals meet, if these are most of the normals across it; by RANSAC with a fixed seed.
/// @param normals unit
std::optional<BodyAxis> findBodyAxis(const std::vector<Eigen::Vector3f>& points,
                                     const std::vector<Eigen::Vector3f>& normals);

}  // namespace sks
