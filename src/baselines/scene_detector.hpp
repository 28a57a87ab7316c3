// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/stages/matching.hpp>

#include "baselines/hypotheses.hpp"

namespace sks::baselines {

/// A baseline as a composition: the detector's stages up to the matches, a grouping, a check or none, and suppression
/// of duplicates. Immutable: may be called from several threads. Same cloud, same result.
class SceneDetector {
public:
  /// @param check may be empty
  /// @param half_support the support that scores 0.5: support / (support + half_support), whatever the scene
  /// @throws Error(bad_usage), Error(incompatible) like Detector
  SceneDetector(std::shared_ptr<const Codebook> codebook, const Settings& settings, Grouping grouping,
                HypothesisCheck check, double half_support);

  /// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
  DetectionResult detect(const Cloud& cloud) const;

private:
  std::shared_ptr<const Codebook> codebook_;
  Settings settings_;
  Matcher matcher_;
  FramedModels models_;
  Grouping grouping_;
  HypothesisCheck check_;
  double half_support_;
};

}  // namespace sks::baselines
