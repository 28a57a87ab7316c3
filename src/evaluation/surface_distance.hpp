// SPDX-License-Identifier: BSD-3-Clause
// The maximum symmetry-aware distances of the BOP challenge: T. Hodan et al., "BOP Challenge 2020 on 6D Object
// Localization", ECCV Workshops 2020, section 2.2. Of all true poses that look the same the nearest one counts.
#pragma once

#include <Eigen/Geometry>

#include "evaluation/object_model.hpp"
#include "evaluation/scene_depth.hpp"

namespace sks {

/// MSSD: greatest distance between a point where the found pose puts it and where the true one does [m].
double surfaceDistance(const ObjectModel& model, const Eigen::Isometry3d& T_scene_found,
                       const Eigen::Isometry3d& T_scene_true);

/// MSPD: the same in the picture, between projections [px]. Infinite where a point lies behind the camera.
double projectionDistance(const ObjectModel& model, const SceneCamera& camera, const Eigen::Isometry3d& T_scene_found,
                          const Eigen::Isometry3d& T_scene_true);

}  // namespace sks
