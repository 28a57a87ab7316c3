// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>

#include "core/verification/pose_evidence.hpp"
#include "core/verification/surface_sample.hpp"

namespace sks {

/// About 80 points of a view's stored surface, spread evenly, with their weights and colours: what a quick look at a
/// pose reads, side by side.
struct RoughSurface {
  RoughSurface() = default;
  explicit RoughSurface(const TrainingView& view);

  SurfaceSample sample;
  std::vector<float> shape, shape_and_color;  ///< as in SurfaceWeight
  std::vector<Eigen::Vector3f> colors;        ///< empty without colour
};

/// A quick look at a rough pose, along the sensor's rays only: how much of the surface the scene confirms. Points count
/// by their weight.
struct RoughSupport {
  int points = 0;        ///< confirmed
  double supported = 0;  ///< their weights
  double visible = 0;    ///< weights of all that should be seen; half where nothing was measured

  /// Of a pose without votes: the fraction that is confirmed, and how much that is; 0 for too few points.
  double scoreWithoutVotes() const;
};

RoughSupport roughSupport(const RoughSurface& surface, const SceneView& scene, const Eigen::Isometry3d& T_scene_model);

}  // namespace sks
