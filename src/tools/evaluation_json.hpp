// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "evaluation/evaluation.hpp"

namespace sks::tools {

/// The result of `sks evaluate` (docs/evaluate.md). Undefined values are null. But for the keys `time_ms` and
/// `peak_memory_mb`, the same detections give the same JSON, whatever the number of threads.
/// @param objects of the codebook, whose order gives them their colours
nlohmann::json evaluationJson(const Evaluation& evaluation, const std::vector<std::string>& objects);

/// The same of recorded detections, of which codebook, settings, memory and the times of the stages are not known.
nlohmann::json recordedJson(const Evaluation& evaluation);

}  // namespace sks::tools
