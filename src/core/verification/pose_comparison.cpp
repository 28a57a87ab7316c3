// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/pose_comparison.hpp"

#include <algorithm>
#include <numeric>

namespace sks {
namespace {

constexpr double uncertain_rays = 1;  // keeps the agreement of few rays low

}  // namespace

PoseComparison::PoseComparison(const ModelSurface& model, const SceneView& scene, const VerificationSettings& settings,
                               double object_size)
    : model_(model), scene_(scene), settings_(settings), object_size_(float(object_size)) {}

std::size_t PoseComparison::add(const Eigen::Isometry3d& T_scene_model, double factor) {
  factors_.push_back(factor);
  poses_.push_back(agreementAlongRays(model_, scene_, settings_, T_scene_model, object_size_));
  most_met_ = std::max(most_met_, poses_.back().met);
  return poses_.size() - 1;
}

double PoseComparison::agreement(std::size_t i) const {
  const RayAgreement& pose = poses_[i];
  return factors_[i] * 2 * pose.agreeing * pose.pattern / (pose.rays + most_met_ + uncertain_rays);
}

std::vector<std::size_t> PoseComparison::ranked(std::size_t most) const {
  std::vector<std::size_t> order(poses_.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [this](std::size_t a, std::size_t b) { return agreement(a) > agreement(b); });
  order.resize(std::min(most, order.size()));
  return order;
}

}  // namespace sks
