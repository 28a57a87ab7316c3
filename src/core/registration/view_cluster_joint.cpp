// SPDX-License-Identifier: BSD-3-Clause
// Views on known planes that were put together all at once: what is kept of them.
#include <algorithm>
#include <cmath>

#include "core/registration/view_cluster.hpp"

namespace sks {
namespace {

// How far the common poses hold what surfaces do not tell, like the turn of a can that its print told [rad], [m].
constexpr double held_turn = 0.02, held_shift = 0.004;
constexpr std::size_t contradicted_points = 800;

/// A relative pose in the three motions that planes leave.
PoseEdge heldEdge(const std::vector<CapturedView>& views, std::size_t a, std::size_t b, const Eigen::Isometry3d& T_b_a,
                  double slack) {
  const Eigen::Vector3d up = views[b].plane->normal();
  const Eigen::Matrix3d along = up * up.transpose();
  PoseEdge edge{a, b, T_b_a, {}};
  edge.information.pivot = T_b_a * views[a].center;
  edge.information.matrix.topLeftCorner<3, 3>() = along / std::pow(slack * held_turn, 2);
  edge.information.matrix.bottomRightCorner<3, 3>() =
      (Eigen::Matrix3d::Identity() - along) / std::pow(slack * held_shift, 2);
  return edge;
}

}  // namespace

void ViewCluster::adopt(const ViewPoses& poses, double slack) {
  poses_ = poses;
  const std::vector<CapturedView>& views = table_.views();
  const LoopLimits wide{slack * loops_.angle, slack * loops_.shift};
  std::vector<PoseEdge> all;
  for (std::size_t a = 0; a < poses_.size(); ++a) {
    for (std::size_t b = a + 1; b < poses_.size(); ++b) {
      if (!poses_[a] || !poses_[b]) continue;
      const Eigen::Isometry3d T_b_a = poses_[b]->inverse() * *poses_[a];
      all.push_back(heldEdge(views, a, b, T_b_a, slack));
      for (const std::size_t r : table_.of(a, b)) {
        const ViewRelation& relation = table_.at(r);
        if (!(relation.score > 0) || !nearlySame(T_b_a, relation.T_b_a, views[a].center, wide)) continue;
        edges_.push_back({a, b, relation.T_b_a, relation.information});
        scores_.push_back(relation.score);
        weight_ += relation.score;
      }
    }
  }
  if (slack <= 1) dropOpenLoops();
  all.insert(all.end(), edges_.begin(), edges_.end());
  solve(all);
}

std::vector<std::ptrdiff_t> ViewCluster::dropContradicted() {
  const std::vector<CapturedView>& views = table_.views();
  const std::size_t n = poses_.size();
  std::vector<double> against(n * n, 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      if (!poses_[a] || !poses_[b]) continue;
      const std::size_t stride =
          std::max<std::size_t>(1, std::max(views[a].points.size(), views[b].points.size()) / contradicted_points);
      const double share =
          compareViews(views[a], views[b], poses_[b]->inverse() * *poses_[a], settings_.verification, stride)
              .contradicted();
      against[a * n + b] = against[b * n + a] = share / limits_.most_contradicted;
    }
  }
  std::vector<std::ptrdiff_t> opponents(n, -1);
  for (std::size_t step = 0; step < n; ++step) {  // each drops a view: the one that most others contradict
    std::size_t worst = n, most = 0;
    double largest = 0;
    for (std::size_t v = 0; v < n; ++v) {
      if (!poses_[v]) continue;
      std::size_t count = 0;
      double sum = 0;
      for (std::size_t t = 0; t < n; ++t) {
        if (!poses_[t] || against[v * n + t] <= placement_slack) continue;
        ++count;
        sum += against[v * n + t];
      }
      if (count < most || (count == most && sum <= largest)) continue;
      worst = v;
      most = count;
      largest = sum;
    }
    if (worst == n) break;
    for (std::size_t t = 0; t < n; ++t) {
      if (!poses_[t] || against[worst * n + t] <= placement_slack) continue;
      if (opponents[worst] < 0 || against[worst * n + t] > against[worst * n + std::size_t(opponents[worst])])
        opponents[worst] = std::ptrdiff_t(t);
    }
    poses_[worst].reset();
  }
  dropForeign();
  return opponents;
}

void ViewCluster::dropUnshared() {
  const std::vector<CapturedView>& views = table_.views();
  for (std::size_t step = 0; step < poses_.size(); ++step) {  // each drops some
    bool dropped = false;
    for (std::size_t v = 0; v < poses_.size(); ++v) {
      if (!poses_[v]) continue;
      std::size_t sharing = 0;
      for (std::size_t t = 0; t < poses_.size(); ++t) {
        if (!poses_[t] || t == v) continue;
        const std::size_t stride = std::max<std::size_t>(1, views[v].points.size() / contradicted_points);
        const Eigen::Isometry3d T = poses_[t]->inverse() * *poses_[v];
        sharing +=
            compareViews(views[v], views[t], T, settings_.verification, stride).overlap() >= limits_.least_overlap;
      }
      if (sharing >= fewest_edges) continue;
      poses_[v].reset();
      dropped = true;
    }
    if (!dropped) return;
  }
}

}  // namespace sks
