// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/classification.hpp>

#include "baselines/hypotheses.hpp"

namespace sks::baselines {

/// Classifies isolated objects by the group of correspondences with most inliers, without verification. Immutable: may
/// be called from several threads.
class GroupClassifier {
public:
  /// @throws Error(bad_usage), Error(incompatible) like Classifier
  GroupClassifier(std::shared_ptr<const Codebook> codebook, const Settings& settings, Grouping grouping);

  /// @throws like Classifier::classify()
  Classification classify(const Cloud& cloud, ViewKind kind) const;

private:
  std::shared_ptr<const Codebook> codebook_;
  Settings settings_;
  Matcher matcher_;
  FramedModels models_;
  Grouping grouping_;
};

}  // namespace sks::baselines
