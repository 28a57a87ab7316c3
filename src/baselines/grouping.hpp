// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "baselines/framed_models.hpp"
#include "baselines/method_settings.hpp"

namespace sks::baselines {

/// Correspondences that agree on a pose of a model.
struct Group {
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  pcl::Correspondences inliers;
};

/// Finds the groups of one model's matches. Called from several threads.
using Grouping = std::function<std::vector<Group>(const FramedModel&, const FramedKeypoints& scene)>;

/// Discrete 3-D Hough voting with local reference frames, by PCL, which removes outliers by RANSAC.
Grouping houghGrouping(const TombariSettings& settings);

/// Geometric consistency, by PCL, which removes outliers by RANSAC.
Grouping consistencyGrouping(const ChenSettings& settings);

/// Discrete 3-D Hough voting by PCL with a threshold that adapts to the model's highest bin, then RANSAC twice: within
/// the bin, and among all of the model's matches that fit what the first one found.
/// @param spacing of the keypoints [m], to which the thresholds of the inliers adapt
Grouping selfAdaptedGrouping(const ZhouSettings& settings, const RansacSettings& ransac, double spacing);

/// The pairs of a model's correspondences in two lists of equal length [m].
struct PointPairs {
  std::vector<Eigen::Vector3d> model, scene;
};
PointPairs pairsOf(const pcl::Correspondences& correspondences, const FramedModel& model, const FramedKeypoints& scene);

/// Those of the correspondences that a pose takes to within `distance` of their scene keypoint [m].
pcl::Correspondences inliersOf(const pcl::Correspondences& correspondences, const FramedModel& model,
                               const FramedKeypoints& scene, const Eigen::Isometry3d& T_scene_model, double distance);

/// Groups of what a class of PCL found: least squares over the inliers. Where RANSAC failed, PCL returns all
/// correspondences and the identity; so only what lies within `distance` of the pose of all is kept, if that is enough.
std::vector<Group> groupsOf(const std::vector<pcl::Correspondences>& clusters, const FramedModel& model,
                            const FramedKeypoints& scene, double distance);

}  // namespace sks::baselines
