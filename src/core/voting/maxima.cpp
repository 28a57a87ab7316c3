// SPDX-License-Identifier: BSD-3-Clause
#include "core/voting/maxima.hpp"

#include <utility>

namespace sks {

std::vector<ObjectMaximum> findAllMaxima(const std::vector<std::vector<Vote>>& spaces, const Settings& settings,
                                         int threads) {
  std::vector<std::vector<Maximum>> by_object(spaces.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t object = 0; object < spaces.size(); ++object) {
    std::vector<Eigen::Vector3f> positions;
    for (const Vote& vote : spaces[object]) positions.push_back(vote.position);
    by_object[object] = findMaxima(positions, settings.voting);
    const std::size_t limit = std::size_t(settings.detection.max_per_object);
    if (by_object[object].size() > limit) by_object[object].resize(limit);
  }
  std::vector<ObjectMaximum> maxima;
  for (std::size_t object = 0; object < by_object.size(); ++object) {
    for (Maximum& maximum : by_object[object]) maxima.push_back({std::uint32_t(object), std::move(maximum)});
  }
  return maxima;
}

}  // namespace sks
