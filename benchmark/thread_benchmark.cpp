// SPDX-License-Identifier: BSD-3-Clause
// The stages from the cloud to the descriptors, each with one thread ("theirs") and with two.
#include <sks_detector/stages/descriptors.hpp>

#include "core/keypoints/sparse_selection.hpp"
#include "core/surface/normals.hpp"
#include "core/surface/sanitize.hpp"
#include "pair.hpp"
#include "recorded_scenes.hpp"

namespace sks::bench {
namespace {

enum class Stage { sanitize, surface, normals, keypoints, selection, descriptors, all };

/// Runs the stages up to the descriptors and remembers what each made of the scene.
struct Stages {
  Settings settings;
  Cloud input, cloud;
  Surface surface;
  Keypoints grid, selected;
  Descriptors descriptors;

  void run(Stage stage, int count) {
    const bool all = stage == Stage::all;
    if (all || stage == Stage::sanitize) cloud = sanitize(input, settings.sanitize, nullptr, count);
    if (all || stage == Stage::surface) surface = makeSurface(cloud, 1.01 * settings.surface.normal_radius, count);
    if (all || stage == Stage::normals) estimateNormals(surface, settings.surface, Orientation::sensor, count);
    if (all || stage == Stage::keypoints) grid = detectKeypoints(surface, settings.keypoints, count);
    if (all || stage == Stage::selection) {
      measureCurvature(surface, grid, settings.keypoints, settings.surface, count);
      selected = selectKeypoints(grid, settings.keypoints);
    }
    if (all || stage == Stage::descriptors) {
      descriptors = computeDescriptors(surface, selected, DescriptorType::shot, settings.descriptor, count);
    }
  }
};

void secondThread(benchmark::State& state, const char* scene, Stage stage, double wanted) {
  const auto cloud = recordedScene(state, scene);
  if (!cloud) return;
  Stages stages;
  stages.input = *cloud;
  stages.run(Stage::all, threads);
  compare(
      state, [&] { stages.run(stage, 1); }, [&] { stages.run(stage, threads); }, wanted, 15);
}

BENCHMARK_CAPTURE(secondThread, sanitize, unorganized_scene, Stage::sanitize, 0)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, surface, unorganized_scene, Stage::surface, 0)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, normals, unorganized_scene, Stage::normals, 1.7)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, keypoints, unorganized_scene, Stage::keypoints, 0)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, selection, unorganized_scene, Stage::selection, 1.7)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, descriptors, unorganized_scene, Stage::descriptors, 1.7)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, all_stages, unorganized_scene, Stage::all, 1.7)->Apply(asPair);
BENCHMARK_CAPTURE(secondThread, all_stages_organized, organized_scene, Stage::all, 1.7)->Apply(asPair);

}  // namespace
}  // namespace sks::bench
