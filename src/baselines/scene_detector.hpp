// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <sks_detector/cloud.hpp>
#include <sks_detector/detection.hpp>
#include <sks_detector/stages/stages.hpp>

#include "core/pipeline/scene_description.hpp"

namespace sks::baselines {

/// A baseline as a composition of stages: those of the detector up to the nearest codeword of each descriptor, and a
/// verifier. Immutable: may be called from several threads. Same cloud, same result.
class SceneDetector {
public:
  /// @param stages with a verifier @throws Error(bad_usage), Error(incompatible) like Detector
  SceneDetector(std::shared_ptr<const Codebook> codebook, const Settings& settings, const Stages& stages);

  /// @return detections in the order of the verifier
  /// @throws Error(bad_data) for an unusable cloud, Error(incompatible) for a cloud without colour with CSHOT
  DetectionResult detect(const Cloud& cloud) const;

private:
  SceneDescriber describer_;
};

}  // namespace sks::baselines
