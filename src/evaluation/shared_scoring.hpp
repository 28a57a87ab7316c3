// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/sharing/work_share.hpp"
#include "evaluation/evaluation.hpp"

namespace sks {

/// bopScores(), a scene at a time by the processes of a share where one is given. Only the leader's result is whole.
/// @param found the same in all processes
BopScores bopScores(const DataSet& data_set, const std::vector<std::vector<MatchedDetection>>& found,
                    const ModelLoader& loader, int threads, const Progress& progress, WorkShare* share);

/// scoreAsBop(), in the same way. @param evaluation whole in the leader
void scoreAsBop(Evaluation& evaluation, const DataSet& data_set, const ModelLoader& loader, int threads,
                const Progress& progress, WorkShare* share);

}  // namespace sks
