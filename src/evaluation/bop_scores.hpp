// SPDX-License-Identifier: BSD-3-Clause
// Average recall as in the BOP challenge's task of localization, 2019 and later: T. Hodan et al., "BOP Challenge 2020
// on 6D Object Localization", ECCV Workshops 2020.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sks_detector/progress.hpp>

#include "evaluation/model_cache.hpp"
#include "evaluation/scene_matching.hpp"
#include "io/dataset.hpp"

namespace sks {

/// Average recalls in [0, 1] of one object, or of all; absent where an error cannot be taken.
struct BopRecall {
  std::size_t targets = 0;                ///< instances that are to be found
  std::optional<double> vsd, mssd, mspd;  ///< AR_VSD, AR_MSSD, AR_MSPD
  std::optional<double> ar;               ///< their mean, where all three are over the same targets
};

struct BopScores {
  BopRecall total;                                  ///< each over the targets of those objects where it can be taken
  std::map<std::string, BopRecall> objects;         ///< those that have targets
  std::map<std::string, std::string> shortcomings;  ///< of an object: why errors cannot be taken
};

/// Scores what was found. Targets are the instances of which at least 10 % is visible and whose object is not ignored.
/// @param found the detections of each scene, best first, in the order of the data set @param threads change nothing
/// @throws what readCloud() throws; Error(cancelled)
BopScores bopScores(const DataSet& data_set, const std::vector<std::vector<MatchedDetection>>& found,
                    const ModelLoader& loader, int threads, const Progress& progress = {});

}  // namespace sks
