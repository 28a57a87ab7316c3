// SPDX-License-Identifier: BSD-3-Clause
// The stages of this package, as the settings ask for them.
#pragma once

#include <memory>
#include <string>

#include <sks_detector/stages/stages.hpp>

namespace sks {

/// `keypoints.detector`; of grid keypoints the sparse selection (section 4).
class ConfiguredKeypoints : public KeypointStage {
public:
  Keypoints detect(const Surface& surface, const Settings& settings) const override;
  Keypoints select(const Surface& surface, Keypoints keypoints, const Settings& settings) const override;
};

/// SHOT or CSHOT.
class ShotDescriptors : public DescriptorStage {
public:
  /// @param type not `automatic`
  explicit ShotDescriptors(DescriptorType type) : type_(type) {}

  std::string name() const override;
  std::size_t size() const override;
  Descriptors describe(const Surface& surface, const Keypoints& keypoints, const Settings& settings) const override;

private:
  DescriptorType type_;
};

/// The user's stages, with those of this package in place of null; but for the verifier.
/// @throws Error(incompatible) where the codebook holds other descriptors than the stage computes
Stages completed(Stages stages, const Codebook& codebook);

/// The descriptors of a stage. @throws Error(bad_data) where they do not have the shape that it states
Descriptors described(const DescriptorStage& stage, const Surface& surface, const Keypoints& keypoints,
                      const Settings& settings);

/// Whether poses are verified, or the Hough maxima stand as published.
bool verifiesPoses(const Settings& settings);

/// The factor of ObjectMatcher::match() in scenes; 1: only the nearest codeword of all votes.
double ambiguityOf(const Settings& settings);

/// Whether background words compete with those of a codebook.
bool hasBackground(const Codebook& codebook, const Settings& settings);

/// Whether keypoints on planes that are larger than every object are left out.
bool skipsPlanes(const Settings& settings);

}  // namespace sks
