// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sks::tools {

/// A model in a scene of a UniBo set.
struct UniboModel {
  std::string cloud;  ///< path
  std::string pose;   ///< path of the .xf file
};

struct UniboScene {
  std::string cloud;  ///< path
  std::vector<UniboModel> models;
};

/// Reads the .ini file of a scene: `PATH` in [SCENE], `NUMBER`, `MODEL_<i>` and `MODEL_<i>_GROUNDTRUTH` in [MODELS].
/// Paths may have been made on another machine: they are looked for beside the file and in each folder above it up to
/// `root`, with less and less of their beginning.
/// @return nothing where the file describes no scene
/// @throws Error(bad_file) naming the file and the key that is missing, or the path that is not there
std::optional<UniboScene> readUniboIni(const std::string& path, const std::string& root);

}  // namespace sks::tools
