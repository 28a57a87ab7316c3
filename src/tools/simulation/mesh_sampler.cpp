// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <thread>

#include <sks_detector/simulation/training_views.hpp>

#include "simulation/builtin_objects.hpp"
#include "tools/command.hpp"
#include "tools/simulation.hpp"

namespace sks::tools {

MeshSampler meshSampler(int views, double distance, bool noise) {
  MeshTraining training;
  training.views = views;
  training.distance = distance;
  training.noise = noise;
  training.threads = std::max(1, int(std::thread::hardware_concurrency()));
  return [training](const TrainingEntry& entry, double scale) {
    const double unit_given = scale < 1 ? scale : 0;  // metres are the default, and may have been left as they were
    LoadedMesh loaded = findMesh(entry.path, unit_given);
    for (const std::string& warning : loaded.warnings) warn(warning);
    return meshSamples(entry.object, entry.source, std::make_shared<const Mesh>(std::move(loaded.mesh)), training);
  };
}

std::vector<std::string> builtinObjects() {
  return builtinNames();
}

}  // namespace sks::tools
