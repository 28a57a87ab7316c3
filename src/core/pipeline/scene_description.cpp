// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/scene_description.hpp"

#include <algorithm>

#include <sks_detector/error.hpp>

#include "core/keypoints/sparse_selection.hpp"
#include "core/pipeline/stopwatch.hpp"
#include "core/surface/sanitize.hpp"

namespace sks {
namespace {

void checkColor(const Cloud& cloud, const Codebook& codebook) {
  if (codebook.descriptor_type != DescriptorType::cshot || cloud.hasColor()) return;
  throw Error(ErrorCode::incompatible,
              "the codebook '" + codebook.name +
                  "' describes colour (CSHOT), but the cloud has none: use a coloured cloud, or "
                  "train with --set descriptor.type=shot");
}

bool usesColor(const Codebook& codebook) {
  return codebook.descriptor_type == DescriptorType::cshot ||
         std::any_of(codebook.views.begin(), codebook.views.end(),
                     [](const TrainingView& view) { return !view.surface_colors.empty(); });
}

}  // namespace

Settings settingsFor(const Codebook& codebook, Settings settings) {
  validate(settings);
  if (settings.descriptor.type == DescriptorType::automatic) settings.descriptor.type = codebook.descriptor_type;
  std::string conflicts;
  for (const std::string& key : bindingConflicts(codebook.settings, settings)) {
    conflicts += (conflicts.empty() ? "" : ", ") + key + " = " + getSetting(codebook.settings, key) + " (not " +
                 getSetting(settings, key) + ")";
  }
  if (!conflicts.empty()) {
    throw Error(ErrorCode::incompatible, "the codebook '" + codebook.name + "' was trained with " + conflicts +
                                             ": use the same values, or train again");
  }
  return settings;
}

Keypoints selectedKeypoints(const Surface& surface, const Settings& settings, int threads, std::size_t* all,
                            const KeypointFilter& filter) {
  Keypoints keypoints = detectKeypoints(surface, settings.keypoints, threads);
  if (all != nullptr) *all = keypoints.size();
  const bool selects = settings.keypoints.detector == KeypointDetector::grid &&
                       (settings.keypoints.selection != SelectionRule::rank || settings.keypoints.discard > 0);
  if (selects || filter) measureCurvature(surface, keypoints, settings.keypoints, settings.surface, threads);
  if (selects) keypoints = selectKeypoints(keypoints, settings.keypoints);
  return filter ? filter(keypoints) : keypoints;
}

Surface prepareScene(const Cloud& cloud, Orientation orientation, const Codebook& codebook, const Settings& settings,
                     StageTimes& times, StageCounts& counts) {
  checkColor(cloud, codebook);
  Stopwatch stage;
  SanitizeSettings sanitizing = settings.sanitize;
  if (orientation == Orientation::outward) sanitizing.min_range = 0;  // a model's origin is no sensor
  Cloud sanitized = sanitize(cloud, sanitizing, nullptr, threadCount(settings));
  if (!usesColor(codebook)) sanitized.colors.clear();
  times.sanitize = stage.lap();

  Surface surface = prepareSurface(sanitized, settings.surface, orientation, threadCount(settings));
  times.normals = stage.lap();
  counts.input_points = cloud.size();
  counts.points = surface.size();
  return surface;
}

void describeSurface(SceneDescription& scene, const Codebook& codebook, const MatchFunction& match,
                     const Settings& settings, const KeypointFilter& filter, StageTimes& times, StageCounts& counts) {
  const int threads = threadCount(settings);
  Stopwatch stage;
  scene.keypoints = selectedKeypoints(scene.surface, settings, threads, &counts.grid_keypoints, filter);
  times.keypoints = stage.lap();

  scene.descriptors =
      computeDescriptors(scene.surface, scene.keypoints, codebook.descriptor_type, settings.descriptor, threads);
  times.descriptors = stage.lap();

  scene.matches = match(scene.descriptors.values, threads);
  times.matching = stage.lap();

  scene.votes = castVotes(codebook, scene.matches, scene.descriptors, scene.keypoints);
  times.voting = stage.lap();

  counts.keypoints = scene.keypoints.size();
  counts.descriptors = scene.descriptors.keypoints.size();
  counts.votes = scene.matches.size();
}

SceneDescription describeScene(const Cloud& cloud, Orientation orientation, const Codebook& codebook,
                               const MatchFunction& match, const Settings& settings, StageTimes& times,
                               StageCounts& counts) {
  SceneDescription scene;
  scene.surface = prepareScene(cloud, orientation, codebook, settings, times, counts);
  describeSurface(scene, codebook, match, settings, {}, times, counts);
  return scene;
}

}  // namespace sks
