// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/relation_table.hpp"

#include <algorithm>

namespace sks {

double angleBetween(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other) {
  return Eigen::AngleAxisd(T.linear().transpose() * other.linear()).angle();
}

bool nearlySame(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other, const Eigen::Vector3d& center,
                const LoopLimits& limits) {
  return (T * center - other * center).norm() <= limits.shift && angleBetween(T, other) <= limits.angle;
}

std::vector<ViewLoop> closedLoops(const RelationTable& table, const LoopLimits& limits) {
  std::vector<ViewLoop> loops;
  const std::size_t n = table.views().size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (const std::size_t ij : table.of(i, j)) {
        for (std::size_t k = j + 1; k < n; ++k) {
          for (const std::size_t jk : table.of(j, k)) {
            for (const std::size_t ik : table.of(i, k)) {
              const Eigen::Isometry3d around = table.pose(jk, j) * table.pose(ij, i);
              if (!nearlySame(around, table.pose(ik, i), table.views()[i].center, limits)) continue;
              loops.push_back({i, j, k, ij, jk, ik, table.at(ij).score + table.at(jk).score + table.at(ik).score});
            }
          }
        }
      }
    }
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const ViewLoop& a, const ViewLoop& b) { return a.weight > b.weight; });
  return loops;
}

}  // namespace sks
