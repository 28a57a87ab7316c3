// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <sks_detector/simulation/mesh.hpp>
#include <sks_detector/simulation/training_views.hpp>

#include "io/dataset.hpp"

namespace sks {

/// What trainingSamples() needs to train from meshes: files, or `builtin:` and a name.
/// @param warn gets what is odd about a mesh, in words
/// @param folder no file outside of it is read, whatever a mesh names; empty: no confinement
MeshSampler meshSampler(const MeshTraining& training, std::function<void(const std::string&)> warn,
                        const std::string& folder = "");

/// The mesh of a training entry: a file, or `builtin:` and a name. @param scale metres per unit, as for a MeshSampler
/// @throws what findMesh() throws
LoadedMesh entryMesh(const TrainingEntry& entry, double scale, const std::string& folder = "");

}  // namespace sks
