// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <sks_detector/stages/stages.hpp>

namespace sks {

/// The Hough maxima that pass RANSAC, as published: nothing else is asked of them. ICP where
/// `refinement.iterations` asks for it.
class HoughVerifier : public VerifierStage {
public:
  std::vector<Hypothesis> verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                 const Codebook& codebook, const Settings& settings) const override;
};

}  // namespace sks
