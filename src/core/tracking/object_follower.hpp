// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/verification/pose_examiner.hpp"

namespace sks {

/// An object in one cloud, where it was expected.
struct FollowedObject {
  Hypothesis hypothesis;                       ///< the pose that fits best, with its evidence, of a full look
  double hidden = 0;                           ///< share of what faces the sensor that is behind something else
  double confirmed = 0;                        ///< share of what should be seen that the cloud confirms, in [0, 1]
  std::optional<Eigen::Vector3f> color_shift;  ///< as in SightLines, of the whole shift; of a full look
};

/// How closely an object is looked at.
enum class Look {
  quick,  ///< enough for its pose, and whether it is there: rows and columns of the cloud are left out
  full    ///< by all points, as a detection is
};

/// Finds objects again near to where they are expected, in the part of a cloud around them, by the same refinement and
/// the same evidence as a detection (docs/method.md, sections 10 and 11). Immutable once built; thread-safe.
class ObjectFollower {
public:
  /// @param models not null
  ObjectFollower(std::shared_ptr<const VerifiedModels> models, const Settings& settings);

  /// @param expected as it was found last; its votes stay those of the detection
  /// @param starts poses T_cloud_model in which it may be now, at least one
  /// @param color_shift SceneView::color_shift
  FollowedObject follow(const Cloud& cloud, const Hypothesis& expected, const std::vector<Eigen::Isometry3d>& starts,
                        const Eigen::Vector3f& color_shift, Look look) const;

private:
  /// The pose near to `start` that fits best; what the scene tells little about stays as it is there.
  Eigen::Isometry3d fitted(const Hypothesis& expected, const SceneView& scene, const Eigen::Isometry3d& start) const;

  std::shared_ptr<const VerifiedModels> models_;
  Settings settings_;
  std::vector<std::vector<Vote>> no_votes_;  // of each object
};

}  // namespace sks
