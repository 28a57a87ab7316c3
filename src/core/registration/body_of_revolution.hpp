// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/upright_alignment.hpp"
#include "core/registration/view_relation.hpp"

namespace sks {

/// Where the vertical axis of a body of revolution stands: every normal of its surface points to it or away from it.
/// @param T_upright_view a pose of the view with z along the normal of its supporting plane
/// @return x and y in the upright frame; none where normals do not tell it
std::optional<Eigen::Vector2d> revolutionAxis(const CapturedView& view, const Eigen::Isometry3d& T_upright_view);

/// Poses of views of an object that looks the same in every turn about a vertical axis, in shape and colour: z of the
/// model is the axis. No turn is wrong; views are spread evenly, so that the model is seen from all around.
/// Deterministic for any number of threads.
/// @param upright poses of all views on z = 0, z along the normals of their planes
/// @return none, if any two views contradict each other in any turn, or if there are too few to tell
std::optional<ViewPoses> posesOfRevolution(const std::vector<CapturedView>& views,
                                           const std::vector<Eigen::Isometry3d>& upright, const Settings& settings,
                                           const PairLimits& limits, int threads);

}  // namespace sks
