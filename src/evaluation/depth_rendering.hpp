// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "evaluation/object_model.hpp"
#include "evaluation/scene_depth.hpp"

namespace sks {

/// The depths at which the rays through the centres of the pixels meet a model first; both sides of a triangle are
/// seen. Triangles that reach behind the camera are left out.
DepthMap renderDepth(const ObjectModel& model, const Eigen::Isometry3d& T_camera_model, const SceneCamera& camera);

}  // namespace sks
