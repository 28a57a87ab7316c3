// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/settings.hpp>
#include <sks_detector/stages/hypothesis.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/verification/pose_evidence.hpp"

namespace sks {

/// Finds poses that the scene's surface confirms (docs/method.md, beyond the paper). Each correspondence is a pose by
/// itself, since its local reference frames give the rotation. The most promising ones are refined by ICP and compared
/// with the stored surface: what is confirmed, what is hidden, what should be seen but is not. Hypotheses for the same
/// part of the scene compete. Deterministic; immutable once built.
class Verifier {
public:
  explicit Verifier(std::shared_ptr<const Codebook> codebook);

  /// @param spaces votes of each object
  /// @return with their evidence, best first
  std::vector<Hypothesis> findPoses(const std::vector<std::vector<Vote>>& spaces, const SceneView& scene,
                                    const Settings& settings, int threads) const;

  /// Of any view of the codebook along an axis [m].
  float largestExtent() const { return largest_extent_; }

private:
  float largest_extent_ = 0;
  std::shared_ptr<const Codebook> codebook_;
  std::vector<SurfaceWeights> weights_;  // of the points of each view's stored surface
};

}  // namespace sks
