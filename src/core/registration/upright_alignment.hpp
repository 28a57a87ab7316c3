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

/// How views are laid on a model.
struct UprightRounds {
  int outlines = 0;  ///< rounds before all others, in which each view only has to appear inside of what others saw
  int count = 10;
  double start_distance = 0.02, end_distance = 0.008;  ///< farthest pairs of the first and of the last round [m]
  std::size_t points = 150;                            ///< of each view that look for a partner, about
  bool holds_turn = false;                             ///< only the place is looked for
};

/// Point-to-plane ICP of views, moved together, with other views at once, in the three motions that a supporting plane
/// leaves: the turn about z of the model and the shifts along x and y. What appears beside another view's outline is
/// drawn to it. Deterministic; thread-safe.
/// @param poses of all that count; a view is not compared with itself
/// @param moved, fixed indices of views with poses; a view may be both
/// @param motion that is applied to the poses of `moved`, about
/// @return the motion at which they fit
Eigen::Isometry3d alignedMotion(const std::vector<CapturedView>& views, const ViewPoses& poses,
                                const std::vector<std::size_t>& moved, const std::vector<std::size_t>& fixed,
                                const Eigen::Isometry3d& motion, const UprightRounds& rounds);

/// The same of a single view and all others that have poses.
/// @return T_model_view
Eigen::Isometry3d alignedUpright(const std::vector<CapturedView>& views, const ViewPoses& poses, std::size_t view,
                                 const Eigen::Isometry3d& T_model_view, const UprightRounds& rounds);

}  // namespace sks
