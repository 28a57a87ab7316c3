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

/// How many poses of each object are looked at: `verification.candidates`, or fewer, but at least a quarter of these,
/// where they would be more than `verification.total_candidates` of all objects that have votes.
int candidatesOfEach(const std::vector<std::vector<Vote>>& spaces, const VerificationSettings& settings);

/// The most promising poses of each object, at most `of_each`, best first within each object.
std::vector<PoseCandidate> poseCandidates(const Codebook& codebook, const std::vector<RoughSurface>& surfaces,
                                          const std::vector<std::vector<Vote>>& spaces, const SceneView& scene,
                                          const Settings& settings, int of_each, int threads);

}  // namespace sks
