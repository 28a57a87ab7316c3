// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/scene_description.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <sks_detector/error.hpp>

#include "core/keypoints/sparse_selection.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/settings/threads.hpp"
#include "core/surface/cloud_extent.hpp"
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

Cloud usablePoints(const Cloud& cloud, Orientation orientation, const Settings& settings) {
  Cloud usable = sanitize(cloud, sanitizingFor(orientation, settings.sanitize), nullptr, threadCount(settings));
  checkExtent(usable, orientation, settings);
  return usable;
}

Cloud usableCloud(const Cloud& cloud, Orientation orientation, const Codebook& codebook, const Settings& settings) {
  checkColor(cloud, codebook);
  Cloud usable = usablePoints(cloud, orientation, settings);
  if (!usesColor(codebook)) usable.colors.clear();
  return usable;
}

SelectedKeypoints selectedKeypoints(const Surface& surface, const KeypointStage& stage, const Settings& settings,
                                    const std::vector<LargePlane>& planes, float largest_plane) {
  SelectedKeypoints selected{stage.detect(surface, settings), 0};
  selected.detected = selected.keypoints.size();
  selected.keypoints = stage.select(surface, std::move(selected.keypoints), settings);
  if (planes.empty() || !std::isfinite(largest_plane)) return selected;
  if (selected.keypoints.normals.empty()) {
    measureCurvature(surface, selected.keypoints, settings.keypoints, settings.surface, threadCount(settings));
  }
  selected.keypoints = keypointsOffPlanes(selected.keypoints, planes, largest_plane);
  return selected;
}

Keypoints selectedKeypoints(const Surface& surface, const Settings& settings) {
  return selectedKeypoints(surface, ConfiguredKeypoints(), settings).keypoints;
}

StageCounts countsOf(const Cloud& cloud, const SceneDescription& scene, std::size_t detected_keypoints) {
  StageCounts counts;
  counts.input_points = cloud.size();
  counts.points = scene.surface.size();
  counts.grid_keypoints = detected_keypoints;
  counts.keypoints = scene.keypoints.size();
  counts.descriptors = scene.descriptors.keypoints.size();
  counts.votes = scene.matches.size();
  return counts;
}

SceneDescriber::Result SceneDescriber::describe(const Cloud& cloud, Orientation orientation, StageClock& clock) const {
  using Times = StageTimes;
  const int threads = startableThreads(settings);
  SceneDescription scene;
  const Cloud usable = clock.book(&Times::sanitize, usableCloud(cloud, orientation, *codebook, settings));
  scene.surface = clock.book(&Times::normals, prepareSurface(usable, settings.surface, orientation, threads));
  auto selected = clock.book(&Times::keypoints, selectedKeypoints(scene.surface, *stages.keypoints, settings));
  scene.keypoints = std::move(selected.keypoints);
  scene.descriptors =
      clock.book(&Times::descriptors, described(*stages.descriptors, scene.surface, scene.keypoints, settings));
  scene.matches = clock.book(&Times::matching, match(scene.descriptors.values, threads));
  scene.votes = clock.book(&Times::voting, castVotes(*codebook, scene.matches, scene.descriptors, scene.keypoints));
  const StageCounts counts = countsOf(cloud, scene, selected.detected);
  return {std::move(scene), counts};
}

}  // namespace sks
