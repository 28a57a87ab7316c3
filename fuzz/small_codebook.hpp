// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sks_detector/trainer.hpp>

#include "synthetic.hpp"
#include "training_samples.hpp"

namespace sks::fuzz {

/// Settings for clouds so small that thousands are processed in a second.
inline Settings smallSettings() {
  Settings settings;
  settings.threads = 1;
  settings.keypoints.grid_size = 0.06;
  settings.descriptor.radius = 0.12;
  settings.descriptor.type = DescriptorType::shot;
  settings.surface.normal_radius = 0.04;
  settings.training.surface_resolution = 0.02;
  settings.ransac.iterations = 10;
  settings.refinement.iterations = 2;
  settings.refinement.max_points = 20;
  settings.verification.candidates = 3;
  settings.voting.max_iterations = 10;
  return settings;
}

/// An object in front of the camera, as a coarse image.
inline Cloud smallView() {
  return test::view({{test::asymmetricShape(), test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}, 0.016f, 24, 18);
}

inline Codebook smallCodebook() {
  return train({test::sampleOf("thing", smallView()), test::sampleOf("other", smallView())}, smallSettings(), "small");
}

}  // namespace sks::fuzz
