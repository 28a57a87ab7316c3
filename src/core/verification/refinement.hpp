// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/surface.hpp>

#include "core/verification/motion_prior.hpp"

namespace sks {

/// Point-to-plane ICP (Chen and Medioni 1991) of the part of a model that faces the sensor against the scene. Each
/// round pairs the model's points with their nearest scene points within a distance that shrinks from
/// `refinement.start_distance` to `refinement.end_distance`, drops pairs whose normals disagree, and solves for the
/// small motion in least squares with Tukey weights. Deterministic.
/// @param points, normals the model's stored surface, in its own frame [m]; one point per few millimetres
/// @return the refined pose; `T_scene_model` itself where fewer than six pairs are found
Eigen::Isometry3d refinePose(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                             const Surface& scene, const RefinementSettings& settings,
                             const Eigen::Isometry3d& T_scene_model, const MotionPrior* prior = nullptr);

/// The same for the surface of the hypothesis' training view; its box moves along.
void refine(Hypothesis& hypothesis, const Codebook& codebook, const Surface& scene, const RefinementSettings& settings);

/// The same for each hypothesis of at least `refinement.min_density`. Deterministic for any number of threads.
void refineHypotheses(std::vector<Hypothesis>& hypotheses, const Codebook& codebook, const Surface& scene,
                      const RefinementSettings& settings, int threads);

}  // namespace sks
