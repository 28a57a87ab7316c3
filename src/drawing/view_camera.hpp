// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

#include "drawing/canvas.hpp"

namespace sks {

/// A pinhole camera that looks at a cloud: x right, y down, z forward.
class ViewCamera {
public:
  /// Stands at the cloud's sensor origin and looks along +z, as depth cameras do, if the points lie there; else it
  /// looks at their centre. A cloud that surrounds its sensor origin, such as a full model, is seen from outside. The
  /// field of view is the smallest that holds the points, but for a few strays.
  ViewCamera(const Cloud& cloud, PictureSize size);

  /// Position in the camera's frame [m].
  Eigen::Vector3d toCamera(const Eigen::Vector3d& point) const { return T_camera_cloud_ * point; }
  /// Pixel of a position in the camera's frame, whose z must be positive.
  Eigen::Vector2d pixel(const Eigen::Vector3d& in_camera) const;
  /// Direction of the ray through a pixel, with z = 1.
  Eigen::Vector3d ray(double column, double row) const;

private:
  Eigen::Isometry3d T_camera_cloud_ = Eigen::Isometry3d::Identity();
  double focal_ = 1;
  Eigen::Vector2d center_;
};

/// Nothing nearer to the camera than this is drawn [m].
constexpr double near_plane = 0.01;

}  // namespace sks
