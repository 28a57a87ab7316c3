// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/simulation/mesh.hpp>

namespace sks {

/// Groups of the objects that the program makes itself: household (mug, bottle, bowl, box, drill, duck), small (30 to
/// 40 mm), flat (6 mm high, 50 to 200 mm wide) and thin (13 mm thick, 150 to 400 mm long).
std::vector<std::string> builtinGroups();

/// Names of the objects of a group. @throws Error(bad_usage) naming the groups
std::vector<std::string> builtinNames(const std::string& group = "household");

/// One of them, coloured, standing on z = 0 around the z axis. @throws Error(bad_usage) naming those that exist
Mesh builtinObject(const std::string& name);

/// A mesh by the name that command line and data set files give it: `builtin:mug`, or a file for loadMesh().
LoadedMesh findMesh(const std::string& name, double scale = 0, const std::string& folder = "");

}  // namespace sks
