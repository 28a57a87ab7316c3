// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <sks_detector/stages/point_grid.hpp>
#include <sks_detector/stages/voting.hpp>

#include "core/voting/gaussian_kernel.hpp"

namespace sks {

/// Kernel density of one object's weighted votes anywhere (eq. 3 without its constant); thread-safe once built.
class VoteDensity {
public:
  /// @param bandwidth of the Gaussian kernel [m], which is cut off at three times that
  VoteDensity(const std::vector<Vote>& votes, double bandwidth);

  double at(const Eigen::Vector3f& position) const;

  /// Votes within the bandwidth of a position, whatever their weight.
  std::uint32_t count(const Eigen::Vector3f& position) const;

private:
  GaussianKernel<float> kernel_;
  PointGrid grid_;
  std::vector<float> weights_;  // of the votes, in the order of the grid
  float bandwidth_;
};

}  // namespace sks
