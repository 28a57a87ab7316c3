// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "evaluation/keypoint_study.hpp"

namespace sks::tools {

/// The result of `sks keypoints` (docs/keypoints.md). But for the keys `time_ms` and `relative_time`, the same data set
/// gives the same JSON.
nlohmann::json keypointJson(const KeypointStudy& study);

/// Means and times of each kind for people.
std::string keypointTable(const KeypointStudy& study);

/// The curves of the paper's figure 4: for each kind, C_rk and T_diff ranked from best to worst, each on its own.
std::string keypointCsv(const KeypointStudy& study);

}  // namespace sks::tools
