// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <sks_detector/dataset.hpp>
#include <sks_detector/evaluation.hpp>
#include <sks_detector/progress.hpp>

namespace sks::tools {

/// Makes the folder and checks that plots can be drawn, before an evaluation takes its time.
/// @throws Error(bad_file) naming the folder, or what has to be installed
void preparePlots(const std::string& folder);

/// Writes evaluation.json, the plots of scripts/plot_evaluation.py and one picture a scene (scenes/NAME.png).
/// @throws Error(bad_file), Error(cancelled)
void writePlots(const std::string& folder, const DataSet& data_set, const Evaluation& evaluation,
                const nlohmann::json& json, const Progress& progress);

}  // namespace sks::tools
