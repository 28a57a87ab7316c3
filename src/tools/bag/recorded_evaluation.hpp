// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "evaluation/evaluation.hpp"
#include "io/dataset.hpp"
#include "tools/bag/recorded_detections.hpp"

namespace sks::tools {

/// What stands in the clouds, by their stamps.
struct RecordedTruth {
  std::string name;         ///< of the data set, or the bag's file
  double max_distance = 0;  ///< of the matching rule [m]
  std::map<ros::Time, Scene> scenes;
};

/// Ground truth that was recorded.
/// @param bag path of its file
/// @throws Error(bad_data) where detections are in another
/// frame than their truth
RecordedTruth truthFromArrays(const std::string& bag, const RecordedDetections& truth, const RecordedDetections& found,
                              double max_distance);

/// Gives ground truth that was recorded the symmetries that a data set file declares for the models of the same object
/// and file name.
void addSymmetries(const DataSet& data_set, RecordedTruth& truth);

/// Ground truth of a data set file: scenes called by the stamps of their clouds, as `sks bag extract` does, or as many
/// scenes as there are stamps, in their order.
/// @param stamps of the clouds, or of the detections where there are no clouds
/// @throws Error(bad_data) where scenes and stamps cannot be brought together
RecordedTruth truthFromDataSet(const DataSet& data_set, const std::vector<ros::Time>& stamps);

/// How recorded detections came off.
struct RecordedEvaluation {
  Evaluation evaluation;          ///< `times` has the total alone; `settings` are not known
  std::size_t unanswered = 0;     ///< clouds with ground truth without detections: dropped by the node
  std::vector<ros::Time> stamps;  ///< of the scenes
  std::vector<std::string> warnings;
};

/// Scores recorded detections like `sks evaluate`.
/// @param count_unanswered clouds without detections count as clouds in which nothing was found
/// @throws Error(bad_data) where no array of detections has the stamp of a cloud with ground truth
RecordedEvaluation evaluateRecorded(const RecordedTruth& truth, const RecordedDetections& found, double threshold,
                                    bool count_unanswered);

}  // namespace sks::tools
