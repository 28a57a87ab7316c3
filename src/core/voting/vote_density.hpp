// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <sks_detector/stages/point_grid.hpp>
#include <sks_detector/stages/voting.hpp>

namespace sks {

/// Kernel density of one object's weighted votes anywhere (eq. 3 without its constant); thread-safe once built.
class VoteDensity {
public:
  /// @param bandwidth of the Gaussian kernel [m], which is cut off at three times that
  VoteDensity(const std::vector<Vote>& votes, double bandwidth)
      : grid_(positionsOf(votes), reach * bandwidth), bandwidth_(float(bandwidth)) {
    for (const std::uint32_t i : grid_.source) weights_.push_back(votes[i].weight);
  }

  double at(const Eigen::Vector3f& place) const {
    double density = 0;
    const float factor = -0.5f / (bandwidth_ * bandwidth_);
    grid_.forEachNeighbor(place, reach * bandwidth_, runs(),
                          [&](std::uint32_t j, float squared) { density += weights_[j] * std::exp(factor * squared); });
    return density;
  }

  /// Votes within the bandwidth of a place, whatever they weigh.
  std::uint32_t count(const Eigen::Vector3f& place) const {
    std::uint32_t votes = 0;
    grid_.forEachNeighbor(place, bandwidth_, runs(), [&](std::uint32_t, float) { ++votes; });
    return votes;
  }

private:
  static constexpr float reach = 3;

  static std::vector<PointGrid::Run>& runs() {
    thread_local std::vector<PointGrid::Run> kept;  // from place to place
    return kept;
  }

  static std::vector<Eigen::Vector3f> positionsOf(const std::vector<Vote>& votes) {
    std::vector<Eigen::Vector3f> positions;
    positions.reserve(votes.size());
    for (const Vote& vote : votes) positions.push_back(vote.position);
    return positions;
  }

  PointGrid grid_;
  std::vector<float> weights_;  // of the votes, in the order of the grid
  float bandwidth_;
};

}  // namespace sks
