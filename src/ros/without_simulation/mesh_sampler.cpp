// SPDX-License-Identifier: BSD-3-Clause
#include "ros/mesh_sampler.hpp"

#include <sks_detector/error.hpp>

namespace sks_detector {

sks::MeshSampler meshSampler(int) {
  return [](const sks::TrainingEntry& entry, double) -> std::vector<sks::TrainingSample> {
    throw sks::Error(sks::ErrorCode::bad_usage,
                     entry.source +
                         " is a mesh, but this node was built without its virtual camera: install libassimp-dev, "
                         "libembree-dev and libbullet-dev, and build it again");
  };
}

}  // namespace sks_detector
