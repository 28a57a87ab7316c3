// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "evaluation/classification.hpp"

namespace sks::tools {

/// The result of `sks classify` (docs/classification.md). But for the key `time_ms`, the same set gives the same JSON.
nlohmann::json classificationJson(const ClassificationEvaluation& evaluation);

/// Accuracy of each object, confusion matrix and mean times for people.
std::string classificationTable(const ClassificationEvaluation& evaluation);

}  // namespace sks::tools
