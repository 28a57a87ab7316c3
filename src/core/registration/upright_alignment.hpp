// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "core/registration/captured_view.hpp"

namespace sks {

/// Poses T_model_view of views; none: a view is not part of the model.
using ViewPoses = std::vector<std::optional<Eigen::Isometry3d>>;

/// How a view is laid on a model.
struct UprightRounds {
  int count = 10;
  double start_distance = 0.02, end_distance = 0.008;  ///< farthest pairs of the first and of the last round [m]
  std::size_t points = 150;                            ///< of each view that look for a partner, about
};

/// Point-to-plane ICP of a view with all others of a model at once, in the three motions that a supporting plane
/// leaves: the turn about z of the model and the shifts along x and y. Deterministic; thread-safe.
/// @param view whose own pose among `poses` does not count
Eigen::Isometry3d alignedUpright(const std::vector<CapturedView>& views, const ViewPoses& poses, std::size_t view,
                                 const Eigen::Isometry3d& T_model_view, const UprightRounds& rounds);

}  // namespace sks
