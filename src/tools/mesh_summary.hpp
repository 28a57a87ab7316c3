// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <sks_detector/simulation/mesh.hpp>

namespace sks::tools {

/// What `sks info` prints of a mesh: triangles, size in millimetres, colours and textures.
std::string meshText(const std::string& path, const LoadedMesh& loaded);
nlohmann::json meshJson(const std::string& path, const LoadedMesh& loaded);

}  // namespace sks::tools
