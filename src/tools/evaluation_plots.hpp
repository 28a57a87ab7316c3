// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include <sks_detector/cloud.hpp>
#include <sks_detector/progress.hpp>

#include "evaluation/evaluation.hpp"

namespace sks::tools {

/// Makes the folder and checks that plots can be drawn, before an evaluation takes its time.
/// @throws Error(bad_file) naming the folder, or what has to be installed
void preparePlots(const std::string& folder);

/// The cloud of a scene, by its index in Evaluation::scenes; an empty one where there is none to draw.
using SceneClouds = std::function<Cloud(std::size_t scene)>;

/// Writes evaluation.json, the plots of scripts/plot_evaluation.py and one picture a scene (scenes/NAME.png).
/// @throws Error(bad_file), Error(cancelled)
void writePlots(const std::string& folder, const SceneClouds& clouds, const Evaluation& evaluation,
                const nlohmann::json& json, const Progress& progress);

}  // namespace sks::tools
