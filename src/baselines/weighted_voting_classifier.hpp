// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/classification.hpp>
#include <sks_detector/object_matching.hpp>

#include "baselines/method_settings.hpp"

namespace sks::baselines {

/// Classifies isolated objects by weighted votes in one continuous Hough space per class (Seib). Each class's nearest
/// codeword votes, with a weight that falls with its distance over that of the nearest of all. Immutable: may be called
/// from several threads.
class WeightedVotingClassifier {
public:
  /// @throws Error(bad_usage), Error(incompatible) like Classifier
  WeightedVotingClassifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, const SeibSettings& own);

  /// @throws like Classifier::classify()
  Classification classify(const Cloud& cloud, ViewKind kind) const;

private:
  std::shared_ptr<const Codebook> codebook_;
  Settings settings_;
  SeibSettings own_;
  ObjectMatcher matcher_;
  std::vector<double> strength_;  // of one vote, for each object
};

}  // namespace sks::baselines
