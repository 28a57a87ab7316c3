// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mesh_sampler.hpp"

#include <memory>
#include <utility>

#include "simulation/builtin_objects.hpp"

namespace sks {

MeshSampler meshSampler(const MeshTraining& training, std::function<void(const std::string&)> warn) {
  return [training, warn = std::move(warn)](const TrainingEntry& entry, double scale) {
    const double unit_given = scale < 1 ? scale : 0;  // metres are the default, and may have been left as they were
    LoadedMesh loaded = findMesh(entry.path, unit_given);
    for (const std::string& warning : loaded.warnings) warn(warning);
    return meshSamples(entry.object, entry.source, std::make_shared<const Mesh>(std::move(loaded.mesh)), training);
  };
}

}  // namespace sks
