// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/progress.hpp>
#include <sks_detector/simulation/camera_model.hpp>

namespace sks::tools {

/// Writes the twin of each scene of a data set into a folder: scenes/ and dataset.yaml, as SimulatedSet does.
/// @param data_set its file; the objects whose poses are known must be trained from meshes @param camera its errors
/// @return path of the new data set file @throws Error(bad_data) naming a scene without poses, Error(bad_file)
std::string writeTwins(const std::string& data_set, const std::string& folder, const CameraModel& camera, int threads,
                       const Progress& progress);

}  // namespace sks::tools
