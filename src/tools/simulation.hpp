// SPDX-License-Identifier: BSD-3-Clause
// What the command line needs of the virtual camera. Where that is left out of the build, these say what is missing.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "io/dataset.hpp"

namespace sks::tools {

void addSimulate(CLI::App& app);

/// Renders training views of meshes. @param distance of the camera [m] @param noise with the errors of a Kinect
MeshSampler meshSampler(int views, double distance, bool noise);

/// Names of the objects that the program makes itself. @throws Error(bad_usage) where it cannot
std::vector<std::string> builtinObjects();

}  // namespace sks::tools
