// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// Names of the household objects that the program makes itself: mug, bottle, bowl, box, drill, duck.
std::vector<std::string> builtinNames();

/// One of them, coloured, standing on z = 0 around the z axis. @throws Error(bad_usage) naming those that exist
Mesh builtinObject(const std::string& name);

/// A mesh by the name that command line and data set files give it: `builtin:mug`, or a file for loadMesh().
LoadedMesh findMesh(const std::string& name, double scale = 0, const std::string& folder = "");

}  // namespace sks
