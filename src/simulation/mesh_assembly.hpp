// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/simulation/mesh.hpp>

#include "simulation/file_mesh.hpp"

namespace sks {

/// Makes triangles and colours of what a file states. A mesh of which a part has no colour is one without: made-up
/// colours would be trained. Vertices stay in the unit that they are in.
/// @throws Error(bad_data) without the name of the file
LoadedMesh assembleMesh(const FileMesh& file, const MeshFiles& files);

}  // namespace sks
