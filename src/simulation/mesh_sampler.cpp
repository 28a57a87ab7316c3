// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mesh_sampler.hpp"

#include <memory>
#include <utility>

#include "simulation/builtin_objects.hpp"

namespace sks {

MeshSampler meshSampler(const MeshTraining& training, std::function<void(const std::string&)> warn,
                        const std::string& folder) {
  return [training, warn = std::move(warn), folder](const TrainingEntry& entry, double scale) {
    const LoadedMesh loaded = entryMesh(entry, scale, folder);
    for (const std::string& warning : loaded.warnings) warn(warning);
    if (loaded.states_unit && entry.scale.value_or(0) > 0) {
      warn(entry.path + ": it states its unit itself, which is used instead of the one that is given for it");
    }
    const auto load = [entry, scale, folder] {
      return std::make_shared<const Mesh>(entryMesh(entry, scale, folder).mesh);
    };
    return meshSamples(entry.object, entry.source, loaded.mesh, load, training);
  };
}

LoadedMesh entryMesh(const TrainingEntry& entry, double scale, const std::string& folder) {
  // metres are the default of data sets, and may have been left as they were
  const double unit_given = entry.scale || scale != 1 ? scale : 0;
  return findMesh(entry.path, unit_given, folder);
}

}  // namespace sks
