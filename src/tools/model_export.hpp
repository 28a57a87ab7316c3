// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/codebook.hpp>

namespace sks::tools {

/// Makes the folder where it is missing, and checks that each object's name is fit for a file.
/// @throws Error(bad_usage), Error(bad_file)
void prepareModelExport(const std::string& folder, const std::vector<std::string>& objects);

/// Writes the model of an object: `NAME.ply`, a cloud with normals and colours, and `NAME_mesh.ply`, triangles between
/// points about `spacing` apart. Both binary, in metres, in the model frame.
/// @return the files; none for an empty model @throws Error(bad_file)
std::vector<std::string> exportModel(const std::string& folder, const std::string& object, const FusedModel& model,
                                     double spacing);

}  // namespace sks::tools
