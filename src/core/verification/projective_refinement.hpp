// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>

#include "core/verification/motion_prior.hpp"
#include "core/verification/pose_evidence.hpp"
#include "core/verification/surface_sample.hpp"

namespace sks {

/// refinePose() with pairs along the sensor's rays (Blais and Levine 1995) instead of nearest ones: a point of the
/// model is paired with what the sensor saw in its direction, which takes one look instead of a search.
Eigen::Isometry3d refineAlongRays(const TrainingView& view, const SceneView& scene, const RefinementSettings& settings,
                                  const Eigen::Isometry3d& T_scene_model);

/// Only the first rounds, with the given points.
Eigen::Isometry3d refineAlongRays(const SurfaceSample& sample, const SceneView& scene,
                                  const RefinementSettings& settings, int rounds,
                                  const Eigen::Isometry3d& T_scene_model, const MotionPrior* prior = nullptr);

}  // namespace sks
