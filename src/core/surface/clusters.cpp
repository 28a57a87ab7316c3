// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/clusters.hpp"

#include <algorithm>

#include <sks_detector/stages/point_grid.hpp>

namespace sks {

std::vector<Eigen::Vector3f> at(const std::vector<Eigen::Vector3f>& points, const Indices& indices) {
  std::vector<Eigen::Vector3f> chosen;
  chosen.reserve(indices.size());
  for (const std::uint32_t i : indices) chosen.push_back(points[i]);
  return chosen;
}

std::vector<Indices> findClusters(const std::vector<Eigen::Vector3f>& points, double gap) {
  const PointGrid grid(points, gap);
  std::vector<PointGrid::Run> runs;
  std::vector<bool> taken(points.size(), false);
  std::vector<Indices> clusters;
  for (std::uint32_t first = 0; first < points.size(); ++first) {
    if (taken[first]) continue;
    taken[first] = true;
    Indices cluster{first};
    for (std::size_t i = 0; i < cluster.size(); ++i) {  // grows meanwhile
      grid.forEachNeighbor(points[cluster[i]], float(gap), runs, [&](std::uint32_t k, float) {
        const std::uint32_t neighbor = grid.source[k];
        if (taken[neighbor]) return;
        taken[neighbor] = true;
        cluster.push_back(neighbor);
      });
    }
    std::sort(cluster.begin(), cluster.end());
    clusters.push_back(std::move(cluster));
  }
  const auto larger = [](const Indices& a, const Indices& b) { return a.size() > b.size(); };
  std::stable_sort(clusters.begin(), clusters.end(), larger);
  return clusters;
}

}  // namespace sks
