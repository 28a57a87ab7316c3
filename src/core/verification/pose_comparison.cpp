// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_comparison.hpp"

#include <algorithm>

namespace sks {
namespace {

constexpr double prior_rays = 1;  // keeps the agreement of few rays low

}  // namespace

PoseComparison::PoseComparison(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                               double object_size)
    : model_(model), scene_(scene), settings_(settings), object_size_(float(object_size)) {}

std::size_t PoseComparison::add(const Eigen::Isometry3d& T_scene_model) {
  poses_.push_back(agreementAlongRays(model_, scene_, settings_, T_scene_model, object_size_));
  most_met_ = std::max(most_met_, poses_.back().met);
  return poses_.size() - 1;
}

double PoseComparison::agreement(std::size_t i) const {
  const RayAgreement& pose = poses_[i];
  return 2 * pose.agreeing * pose.pattern / (pose.rays + most_met_ + prior_rays);
}

std::size_t PoseComparison::best() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    if (agreement(i) > agreement(best)) best = i;
  }
  return best;
}

}  // namespace sks
