// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/verification/rough_support.hpp"

namespace sks {

/// A pose by one correspondence: the local frames give the rotation, the keypoints the translation. Or one by which an
/// object would stand where something does.
struct PoseCandidate {
  std::uint32_t object = 0;
  std::uint32_t view = 0;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity();
  double pre_score = 0;  ///< from the votes around it and a rough comparison with the scene
  bool stands = false;   ///< not from a vote, but from what stands alone on a plane
};

/// The most promising poses of each object, at most `verification.candidates`, best first within each object.
/// @param surface_weights of each view
std::vector<PoseCandidate> poseCandidates(const Codebook& codebook, const std::vector<RoughSurface>& surfaces,
                                          const std::vector<std::vector<Vote>>& spaces, const SceneView& scene,
                                          const Settings& settings, int threads);

}  // namespace sks
