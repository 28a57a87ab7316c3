// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "evaluation/evaluation.hpp"

namespace sks::tools {

/// For people: a table of the objects, a sweep over thresholds and the times of the stages. Undefined values are "-".
std::string evaluationTable(const Evaluation& evaluation);

/// The same of recorded detections, whose memory is not known.
std::string recordedTable(const Evaluation& evaluation);

}  // namespace sks::tools
