// SPDX-License-Identifier: BSD-3-Clause
#include "ros/mesh_sampler.hpp"

#include <memory>
#include <utility>

#include <ros/console.h>

#include <sks_detector/simulation/training_views.hpp>

#include "simulation/builtin_objects.hpp"

namespace sks_detector {

sks::MeshSampler meshSampler(int threads) {
  sks::MeshTraining training;
  training.threads = threads;
  return [training](const sks::TrainingEntry& entry, double scale) {
    const double unit_given = scale < 1 ? scale : 0;  // metres are the default, and may have been left as they were
    sks::LoadedMesh loaded = sks::findMesh(entry.path, unit_given);
    for (const std::string& warning : loaded.warnings) ROS_WARN_STREAM(warning);
    const auto mesh = std::make_shared<const sks::Mesh>(std::move(loaded.mesh));
    return sks::meshSamples(entry.object, entry.source, mesh, training);
  };
}

}  // namespace sks_detector
