// SPDX-License-Identifier: BSD-3-Clause
// The stages from a cloud to its votes, which all that works with a codebook has in common.
#pragma once

#include <functional>
#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/codebook.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/descriptors.hpp>
#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/matching.hpp>
#include <sks_detector/stages/surface.hpp>
#include <sks_detector/stages/voting.hpp>

namespace sks {

/// A scene, described and matched.
struct SceneDescription {
  Surface surface;
  Keypoints keypoints;  ///< those that the selection kept
  Descriptors descriptors;
  std::vector<Match> matches;            ///< in the order of the descriptors
  std::vector<std::vector<Vote>> votes;  ///< one Hough space per object
};

/// `settings` where they can be used with a codebook, with the descriptor type that `auto` stands for.
/// @throws Error(bad_usage) for invalid settings, Error(incompatible) naming keys and values that differ from what the
///         codebook was trained with
Settings settingsFor(const Codebook& codebook, Settings settings);

/// What else is left out of measured keypoints, after the selection.
using KeypointFilter = std::function<Keypoints(const Keypoints&)>;

/// The keypoints of a scene after the selection that the settings ask for. @param all where given: how many there were
Keypoints selectedKeypoints(const Surface& surface, const Settings& settings, int threads, std::size_t* all = nullptr,
                            const KeypointFilter& filter = {});

/// Sanitizes a cloud and prepares its surface. @throws like describeScene()
Surface prepareScene(const Cloud& cloud, Orientation orientation, const Codebook& codebook, const Settings& settings,
                     StageTimes& times, StageCounts& counts);

/// Selects keypoints of the scene's surface, describes them, matches and votes. @param match, settings as below
void describeSurface(SceneDescription& scene, const Codebook& codebook, const MatchFunction& match,
                     const Settings& settings, const KeypointFilter& filter, StageTimes& times, StageCounts& counts);

/// Both: from a cloud to its votes; fills in times and counts of these stages.
/// @param match finds the codewords of descriptors of the codebook's size
/// @param settings of settingsFor()
/// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
SceneDescription describeScene(const Cloud& cloud, Orientation orientation, const Codebook& codebook,
                               const MatchFunction& match, const Settings& settings, StageTimes& times,
                               StageCounts& counts);

}  // namespace sks
