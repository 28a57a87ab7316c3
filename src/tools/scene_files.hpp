// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/cloud.hpp>

#include "io/dataset.hpp"

namespace sks::tools {

/// Writes an organised, coloured cloud as `base`.pcd, its colour picture (PNG) and its depth picture (16-bit PNG, mm).
/// @throws Error(bad_file)
void writeSceneFiles(const std::string& base, const Cloud& cloud);

/// A mesh's file as seen from a folder; built-in ones keep their name.
std::string relativeSource(const std::string& source, const std::string& folder);

/// A mesh as an entry of `training` in a data set file in metres.
/// @param cloud its file as it is to stand there @param scale metres per unit; 0: not stated
std::string trainingYaml(const std::string& object, const std::string& cloud, double scale,
                         const std::optional<Symmetry>& symmetry);

}  // namespace sks::tools
