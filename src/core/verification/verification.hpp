// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/stages.hpp>

#include "core/verification/pose_examiner.hpp"

namespace sks {

/// Finds poses that the scene's surface confirms (docs/method.md, beyond the paper). Each correspondence is a pose by
/// itself, since its local reference frames give the rotation. The most promising ones are refined by ICP and compared
/// with the stored surface: what is confirmed, what is occluded, what should be seen but is not; and whether the
/// sensor's own rays and the outline of the whole model agree. Hypotheses for the same part of the scene compete.
/// Deterministic; immutable once built; thread-safe.
class SurfaceVerifier : public VerifierStage {
public:
  /// @param models not null
  explicit SurfaceVerifier(std::shared_ptr<const VerifiedModels> models) : models_(std::move(models)) {}

  /// None: every vote is a proposal.
  std::vector<Hypothesis> propose(const SceneDescription& scene, const Codebook& codebook,
                                  const Settings& settings) const override;

  /// @param codebook the one that it was built for
  /// @return with their evidence, best first
  std::vector<Hypothesis> verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                 const Codebook& codebook, const Settings& settings) const override;

  /// By the evidence.
  double score(const Hypothesis& hypothesis, const Settings& settings) const override;

private:
  std::vector<Hypothesis> findPoses(const SceneDescription& description, SceneView scene, const Settings& settings,
                                    int threads) const;

  std::shared_ptr<const VerifiedModels> models_;
};

}  // namespace sks
