// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/registration/captured_view.hpp"
#include "core/registration/upright_alignment.hpp"

namespace sks {

/// Where the axes of a model come from.
struct ModelAxes {
  std::size_t first = 0;  ///< a tied view that they were taken from
  /// The middle of the box of what that view shows, as it was when the frame began: views that are added later, even
  /// if they leave that view out, do not move it. Model frame [m].
  Eigen::Vector3d first_middle = Eigen::Vector3d::Zero();
};

/// How the first views, so many, are tied when there are no others; no poses at all: they are not.
using TiedBefore = std::function<const ViewPoses&(std::size_t count)>;

/// Gives a model the axes that it had when views could be tied first, while there were only those before them: so the
/// axes stay when views are added. They are those of the first view that was tied then, x pointing to its camera or,
/// without a plane, all as its camera has them; if it is no longer tied, they are handed over by a view that was tied
/// together with it. Deterministic.
/// @param poses of the tied views, at least one; on planes z is their normal already
ModelAxes orientModel(const std::vector<CapturedView>& views, ViewPoses& poses, const TiedBefore& earlier);

/// Index of the first view with a pose, poses.size() if there is none.
std::size_t firstTied(const ViewPoses& poses);

}  // namespace sks
