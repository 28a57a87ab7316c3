// SPDX-License-Identifier: BSD-3-Clause
// What a cluster of views lets go again: edges, loops and views that do not fit the whole.
#include <algorithm>
#include <map>
#include <utility>

#include "core/registration/view_cluster.hpp"

namespace sks {
namespace {

constexpr int fewest_refuting = 2;     // views that saw nothing there: one may have lost a part of the object
constexpr double most_foreign = 0.06;  // of a view's points
constexpr std::size_t judged_points = 800;

}  // namespace

void ViewCluster::realign() {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < poses_.size(); ++a) {
    for (std::size_t b = a + 1; b < poses_.size(); ++b) {
      if (poses_[a] && poses_[b]) pairs.emplace_back(a, b);
    }
  }
  std::vector<ViewRelation> relations(pairs.size());
  const std::vector<CapturedView>& views = table_.views();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    relations[p] = relationAt(views[a], views[b], poses_[b]->inverse() * *poses_[a], settings_, limits_);
  }
  edges_.clear();
  scores_.clear();
  weight_ = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    const ViewRelation& relation = relations[p];
    if (!(relation.score > 0) || !relation.determined) continue;
    if (!nearlySame(poses_[b]->inverse() * *poses_[a], relation.T_b_a, views[a].center, loops_)) continue;
    edges_.push_back({a, b, relation.T_b_a, relation.information});
    scores_.push_back(relation.score);
    weight_ += relation.score;
  }
}

/// Edges that do not fit the common poses, and views that too few edges hold.
void ViewCluster::dropLoose() {
  const auto fits = [&](const PoseEdge& edge) {
    return poses_[edge.a] && poses_[edge.b] &&
           nearlySame(poses_[edge.b]->inverse() * *poses_[edge.a], edge.T_b_a, table_.views()[edge.a].center, loops_);
  };
  for (std::size_t step = 0; step < poses_.size(); ++step) {  // each drops a view
    for (std::size_t e = edges_.size(); e-- > 0;) {
      if (fits(edges_[e])) continue;
      edges_.erase(edges_.begin() + std::ptrdiff_t(e));
      scores_.erase(scores_.begin() + std::ptrdiff_t(e));
    }
    std::vector<std::size_t> count(poses_.size(), 0);
    for (const PoseEdge& edge : edges_) {
      ++count[edge.a];
      ++count[edge.b];
    }
    bool dropped = false;
    for (std::size_t v = 0; v < poses_.size(); ++v) {
      if (!poses_[v] || count[v] >= fewest_edges) continue;
      poses_[v].reset();
      dropped = true;
    }
    if (!dropped) return;
  }
}

/// Share of what a view shows that several others contradict and none confirms: a hand, or a thing that stood beside.
double ViewCluster::foreignShare(std::size_t view) const {
  const CapturedView& own = table_.views()[view];
  const VerificationSettings& settings = settings_.verification;
  const std::size_t stride = std::max<std::size_t>(1, own.points.size() / judged_points);
  std::size_t points = 0, foreign = 0;
  for (std::size_t i = 0; i < own.points.size(); i += stride) {
    int against = 0, confirmed = 0;
    for (std::size_t t = 0; t < poses_.size(); ++t) {
      if (!poses_[t] || t == view) continue;
      const CapturedView& other = table_.views()[t];
      const Eigen::Isometry3f T = (poses_[t]->inverse() * *poses_[view]).cast<float>();
      const Eigen::Vector3f p = T * own.points.point(i);
      const Sighting seen = other.image.look(p, float(settings.support_distance));
      const bool beside =
          seen.sight == Sight::unknown && other.silhouette.isOutside(p, float(settings.support_distance));
      against += seen.sight == Sight::in_front || beside ? 1 : 0;
      confirmed += seen.sight == Sight::at ? 1 : 0;
    }
    ++points;
    foreign += against >= fewest_refuting && confirmed == 0 ? 1 : 0;
  }
  return points > 0 ? double(foreign) / double(points) : 0;
}

void ViewCluster::dropForeign() {
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    if (!poses_[v] || foreignShare(v) <= most_foreign) continue;
    poses_[v].reset();
    foreign_[v] = 1;
  }
}

std::vector<ViewCluster::EdgeLoop> ViewCluster::edgeLoops() const {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edge_of;
  for (std::size_t e = 0; e < edges_.size(); ++e) edge_of[{edges_[e].a, edges_[e].b}] = e;
  std::vector<EdgeLoop> loops;
  for (const auto& [ij, first] : edge_of) {
    for (auto jk = edge_of.lower_bound({ij.second, 0}); jk != edge_of.end() && jk->first.first == ij.second; ++jk) {
      const auto ik = edge_of.find({ij.first, jk->first.second});
      if (ik == edge_of.end()) continue;
      const Eigen::Isometry3d around = edges_[jk->second].T_b_a * edges_[first].T_b_a;
      const Eigen::Isometry3d& direct = edges_[ik->second].T_b_a;
      const Eigen::Vector3d& center = table_.views()[ij.first].center;
      loops.push_back(
          {{first, jk->second, ik->second}, (around * center - direct * center).norm(), angleBetween(around, direct)});
    }
  }
  return loops;
}

/// Of the edges of loops that do not close the weakest ones.
void ViewCluster::dropOpenLoops() {
  for (std::size_t step = edges_.size(); step > 0; --step) {  // each drops an edge
    std::optional<std::size_t> weakest;
    for (const EdgeLoop& loop : edgeLoops()) {
      if (loop.shift <= loops_.shift && loop.angle <= loops_.angle) continue;
      for (const std::size_t e : loop.edges) {
        if (!weakest || scores_[e] < scores_[*weakest]) weakest = e;
      }
    }
    if (!weakest) return;
    edges_.erase(edges_.begin() + std::ptrdiff_t(*weakest));
    scores_.erase(scores_.begin() + std::ptrdiff_t(*weakest));
  }
}

LoopErrors ViewCluster::loopErrors() const {
  std::vector<double> shifts, angles;
  for (const EdgeLoop& loop : edgeLoops()) {
    shifts.push_back(loop.shift);
    angles.push_back(loop.angle);
  }
  LoopErrors errors;
  errors.loops = shifts.size();
  if (shifts.empty()) return errors;
  std::sort(shifts.begin(), shifts.end());
  std::sort(angles.begin(), angles.end());
  errors.median_shift = shifts[shifts.size() / 2];
  errors.median_angle = angles[angles.size() / 2];
  errors.largest_shift = shifts.back();
  errors.largest_angle = angles.back();
  return errors;
}

}  // namespace sks
