// SPDX-License-Identifier: BSD-3-Clause
// The stages from a cloud to its votes, which all that works with a codebook has in common.
#pragma once

#include <cstddef>
#include <limits>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/matching.hpp>
#include <sks_detector/stages/scene.hpp>
#include <sks_detector/stages/stages.hpp>

#include "core/pipeline/stage_clock.hpp"

namespace sks {

/// `settings` where they can be used with a codebook, with the descriptor type that `auto` stands for.
/// @throws Error(bad_usage) for invalid settings, Error(incompatible) naming keys and values that differ from what the
///         codebook was trained with
Settings settingsFor(const Codebook& codebook, Settings settings);

/// The points of a cloud that can be used. @throws Error(bad_data) for an unusable cloud: none left, wrong unit
Cloud usablePoints(const Cloud& cloud, Orientation orientation, const Settings& settings);

/// The points of a cloud that can be used, with colours where the codebook has some.
/// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
Cloud usableCloud(const Cloud& cloud, Orientation orientation, const Codebook& codebook, const Settings& settings);

struct SelectedKeypoints {
  Keypoints keypoints;
  std::size_t detected = 0;  ///< how many there were before the selection
};

/// Detects and selects keypoints, and leaves out those on planes.
/// @param largest_plane keypoints on planes of larger extents are left out [m]
SelectedKeypoints selectedKeypoints(const Surface& surface, const KeypointStage& stage, const Settings& settings,
                                    const std::vector<LargePlane>& planes = {},
                                    float largest_plane = std::numeric_limits<float>::infinity());

/// The keypoints that the settings ask for.
Keypoints selectedKeypoints(const Surface& surface, const Settings& settings);

StageCounts countsOf(const Cloud& cloud, const SceneDescription& scene, std::size_t detected_keypoints);

/// A codebook and how scenes are described and matched with it. Immutable: may be used by several threads.
struct SceneDescriber {
  std::shared_ptr<const Codebook> codebook;
  Settings settings;    ///< of settingsFor()
  Stages stages;        ///< of completed(); the verifier is not used
  MatchFunction match;  ///< finds the codewords of descriptors

  struct Result {
    SceneDescription scene;
    StageCounts counts;
  };

  /// From a cloud to its votes. @throws like usableCloud()
  Result describe(const Cloud& cloud, Orientation orientation, StageClock& clock) const;
};

}  // namespace sks
