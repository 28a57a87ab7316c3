// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/trainer.hpp>

#include "io/captured_views.hpp"
#include "io/dataset.hpp"

namespace sks_detector {

/// What one training is made from.
struct TrainingSet {
  std::string name;  ///< of the data set
  std::vector<sks::TrainingSample> samples;
  std::vector<std::string> warnings;  ///< of the data sets; also names what was captured and is left out
  /// Captured objects with several views, none of them with the plane that the object stood on.
  std::vector<std::string> without_planes;
};

/// Gathers a training set from a data set file and the captured views.
/// @param dataset inside `directory`, as are all clouds that it names; empty: captured views only
/// @param captured whether the captured views are added to those of the data set
/// @throws sks::Error naming the file and line, or what lies outside of the directory
TrainingSet gatherTrainingSet(const std::string& dataset, bool captured, const sks::CapturedViews& views,
                              const std::string& directory, const sks::MeshSampler& sampler);

}  // namespace sks_detector
