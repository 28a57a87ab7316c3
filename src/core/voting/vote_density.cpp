// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/vote_density.hpp"

namespace sks {
namespace {

std::vector<Eigen::Vector3f> positionsOf(const std::vector<Vote>& votes) {
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(votes.size());
  for (const Vote& vote : votes) positions.push_back(vote.position);
  return positions;
}

std::vector<PointGrid::Run>& runs() {
  thread_local std::vector<PointGrid::Run> kept;  // from position to position
  return kept;
}

}  // namespace

VoteDensity::VoteDensity(const std::vector<Vote>& votes, double bandwidth)
    : kernel_(densityKernel(bandwidth)), grid_(positionsOf(votes), 3 * bandwidth), bandwidth_(float(bandwidth)) {
  for (const std::uint32_t i : grid_.source) weights_.push_back(votes[i].weight);
}

double VoteDensity::at(const Eigen::Vector3f& position) const {
  double density = 0;
  grid_.forEachNeighbor(position, kernel_.reach(), runs(),
                        [&](std::uint32_t j, float squared) { density += weights_[j] * kernel_(squared); });
  return density;
}

std::uint32_t VoteDensity::count(const Eigen::Vector3f& position) const {
  std::uint32_t votes = 0;
  grid_.forEachNeighbor(position, bandwidth_, runs(), [&](std::uint32_t, float) { ++votes; });
  return votes;
}

}  // namespace sks
