// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/registration/view_alignment.hpp"

namespace sks {

/// A measured relative pose of two views.
struct PoseEdge {
  std::size_t a = 0, b = 0;  ///< indices of the views
  Eigen::Isometry3d T_b_a = Eigen::Isometry3d::Identity();
  MotionInformation information;
};

/// A view with its pose so far.
struct PoseNode {
  Eigen::Isometry3d T_model_view = Eigen::Isometry3d::Identity();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< of what it shows; its own frame [m]
  std::optional<Eigen::Hyperplane<double, 3>> plane;  ///< that the object stood on, its normal upwards; its own frame
};

/// The poses that agree best with all edges (Ceres, robust loss), the planes lying in z = 0 of the model. Edges count
/// as their information says, but none as better than sensors are. Deterministic.
/// @param fixed index of the view whose pose stays, but for the height and tilt that planes determine
std::vector<Eigen::Isometry3d> optimizedPoses(const std::vector<PoseNode>& nodes, const std::vector<PoseEdge>& edges,
                                              std::size_t fixed);

}  // namespace sks
