// SPDX-License-Identifier: BSD-3-Clause
// The visible surface discrepancy (VSD) of the BOP challenge: T. Hodan et al., "BOP Challenge 2020 on 6D Object
// Localization", ECCV Workshops 2020, section 2.2, with masks of visible pixels as in the challenge since 2019.
#pragma once

#include <vector>

#include "evaluation/scene_depth.hpp"

namespace sks {

/// The fraction of the visible pixels of either pose that only one of them covers, or where their surfaces are too far
/// apart along the ray. A pixel of a pose is visible where nothing was measured more than 15 mm nearer, or nothing at
/// all; and where the found pose covers a visible pixel of the true one.
/// @param found, truth the model's depths in the two poses, of scene.camera
/// @param tolerances for the distance of the surfaces [m]: from there on they are too far apart
/// @return one value in [0, 1] for each tolerance; 1 where nothing is visible
std::vector<double> visibleSurfaceDiscrepancy(const DepthMap& found, const DepthMap& truth, const SceneDepth& scene,
                                              const std::vector<double>& tolerances);

}  // namespace sks
