// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/voting/mean_shift.hpp"

namespace sks {

/// An object at a place, with the correspondences that agree on its pose.
struct Hypothesis {
  std::uint32_t object = 0;
  std::uint32_t view = 0;  ///< the training view whose frame T_scene_model maps; of a shared frame the most similar one
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_scene_box = Eigen::Isometry3d::Identity();  ///< box centre, axes parallel to the model's
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();             ///< full extents [m]
  double density = 0;                  ///< of the inliers' votes at their maximum (eq. 3 without its constant)
  double evidence = 0;                 ///< for the pose, of all that was seen of it; 0 where it was not verified
  std::uint32_t votes = 0;             ///< votes at the maximum before RANSAC
  std::vector<std::uint32_t> inliers;  ///< indices of the votes that RANSAC did not remove
};

/// RANSAC on the pairs {p_t, p_s} of a maximum's votes (section 3.2); then density, least-squares pose and box from
/// the inliers. Pairs are compared within one model frame: that of a training view, or of all views that are
/// registered to each other. The frame with most inliers gives the pose. Votes of frames with fewer than three pairs
/// can be neither confirmed nor refuted: they stay.
/// @return false if fewer than min_inliers agree
bool estimateHypothesis(const Codebook& codebook, std::uint32_t object, const std::vector<Vote>& votes,
                        const Maximum& maximum, const Settings& settings, Hypothesis& hypothesis);

/// Least-squares rigid transform with `to[i] ~ T * from[i]` (Umeyama without scale); needs at least 3 pairs.
Eigen::Isometry3d fitRigid(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to);

}  // namespace sks
