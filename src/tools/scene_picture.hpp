// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <sks_detector/cloud.hpp>

#include "evaluation/evaluation.hpp"

namespace sks::tools {

/// Draws a scene with its detections at or above the threshold and its ground truth, as PNG: what is right is green, a
/// false alarm red, what counts neither way grey; an orange cross with a label marks what was missed.
/// @throws Error(bad_file)
void saveScenePicture(const std::string& path, const Cloud& cloud, const SceneResult& result,
                      const Evaluation& evaluation);

}  // namespace sks::tools
