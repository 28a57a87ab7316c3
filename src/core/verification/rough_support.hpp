// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>

#include "core/verification/pose_evidence.hpp"
#include "core/verification/surface_sample.hpp"

namespace sks {

/// About 80 points of a view's stored surface, spread evenly, with their weights and colours: what a quick look at a
/// pose reads, side by side. The first ones are spread evenly too.
struct RoughSurface {
  RoughSurface() = default;
  explicit RoughSurface(const TrainingView& view);

  SurfaceSample sample;
  std::size_t stride = 1;                     ///< of the sample among the view's points
  float object_size = 0;                      ///< largest extent of the object's box [m]
  std::vector<float> shape, shape_and_color;  ///< as in SurfaceWeight, padded with zeros
  std::vector<Eigen::Vector3f> colors;        ///< empty without colour
};

/// A quick look at a rough pose, along the sensor's rays only: how much of the surface the scene confirms. Points count
/// by their weight.
struct RoughSupport {
  int points = 0;        ///< confirmed
  int facing = 0;        ///< the sensor, whether in sight or not
  double agreement = 0;  ///< of colours, summed over the confirmed points; without colours their number
  double supported = 0;  ///< their weights
  double visible = 0;    ///< weights of all that should be seen; half where nothing was measured

  /// Of a pose without votes: the fraction that is confirmed, and how much that is; 0 for too few points.
  double scoreWithoutVotes() const;
};

/// What a quick look takes for confirmed. By default, what poses of single correspondences need.
struct RoughLimits {
  float distance = 0.015f;     ///< [m] rough poses are that far off
  float agreement = 0.7f;      ///< cosine, about 45 degrees
  float occlusion = 0.02f;     ///< [m]
  float color_slack = 1.5f;    ///< of the tolerance: prints are off by as much as the pose
  bool passes_planes = false;  ///< points of the scene on planes larger than the object speak neither way
  bool glance = false;         ///< looks at about a quarter of the points, which speak for all
};

/// @param least_score of scoreWithoutVotes(): colours are not compared where it cannot be reached
RoughSupport roughSupport(const RoughSurface& surface, const SceneView& scene, const Eigen::Isometry3d& T_scene_model,
                          const RoughLimits& limits = RoughLimits(), double least_score = -1);

}  // namespace sks
