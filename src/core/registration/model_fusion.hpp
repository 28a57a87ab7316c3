// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/registration.hpp>
#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"

namespace sks {

/// Edge of the cubes in which points of views are averaged [m]: half of `training.surface_resolution`.
double fusedSpacing(const Settings& settings);

/// The surface that views saw together: their points averaged in cubes of fusedSpacing(), those seen from the front
/// counting most. What other cameras looked through, or would have seen beside the object, is dropped, and so are stray
/// points; the box is that of the rest, down to z = 0 where views stood on a known plane.
/// @param poses T_model_view of each view; views without one add nothing
FusedModel fuseViews(const std::vector<CapturedView>& views, const std::vector<std::optional<Eigen::Isometry3d>>& poses,
                     const Settings& settings);

/// About one point for each cube of the spacing [m] and side of a thin part, in order of the cubes; the same box.
FusedModel thinnedModel(const FusedModel& model, double spacing);

}  // namespace sks
