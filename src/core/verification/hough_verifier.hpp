// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <sks_detector/codebook.hpp>
#include <sks_detector/stages/stages.hpp>

namespace sks {

/// The Hough maxima that pass RANSAC, as published: nothing else is asked of them. ICP where
/// `refinement.iterations` asks for it. Immutable once built; thread-safe.
class HoughVerifier : public VerifierStage {
public:
  /// Keeps no reference to the codebook.
  explicit HoughVerifier(const Codebook& codebook);

  std::vector<Hypothesis> verify(std::vector<Hypothesis> proposed, const SceneDescription& scene,
                                 const Codebook& codebook, const Settings& settings) const override;

  /// By the votes, as a share of what the training view offers: see scoreOfVotes().
  /// @param hypothesis of the codebook that this was built for
  double score(const Hypothesis& hypothesis, const Settings& settings) const override;

private:
  std::vector<std::size_t> words_of_view_;
};

}  // namespace sks
