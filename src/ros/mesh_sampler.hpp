// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/dataset.hpp"

namespace sks_detector {

/// What trainingSamples() needs to train from meshes; without the virtual camera it throws sks::Error(bad_usage).
sks::MeshSampler meshSampler(int threads);

}  // namespace sks_detector
