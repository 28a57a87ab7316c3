// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_cluster.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sks {
namespace {

constexpr int completions = 2;  // rounds in which pairs are aligned anew from the common poses
constexpr double majority = 2;  // weight of the relations that agree on a pose over that of others

}  // namespace

void ViewCluster::begin(const ViewLoop& loop) {
  poses_[loop.i] = Eigen::Isometry3d::Identity();
  poses_[loop.j] = table_.pose(loop.ij, loop.i).inverse();
  poses_[loop.k] = table_.pose(loop.ik, loop.i).inverse();
  toFrameOf(std::min({loop.i, loop.j, loop.k}));
  optimize();
}

void ViewCluster::grow() {
  for (std::size_t step = 0; step < poses_.size(); ++step) {  // each adds a view
    std::vector<PoseProposal> proposals;
    for (std::size_t view = 0; view < poses_.size(); ++view) {
      if (!poses_[view] && !foreign_[view]) propose(view, proposals);
    }
    std::stable_sort(proposals.begin(), proposals.end(), [](const PoseProposal& a, const PoseProposal& b) {
      return std::make_pair(a.edges >= fewest_edges, a.weight) > std::make_pair(b.edges >= fewest_edges, b.weight);
    });
    const auto allowed =
        std::find_if(proposals.begin(), proposals.end(), [&](const PoseProposal& p) { return isAllowed(p); });
    if (allowed == proposals.end()) return;
    poses_[allowed->view] = allowed->T_model_view;
    optimize();
  }
}

bool ViewCluster::isAllowed(const PoseProposal& p) const {
  if (contradiction(p.view, p.T_model_view) >= 0) return false;
  return p.edges >= fewest_edges || confirmations(p) >= fewest_edges;
}

void ViewCluster::complete() {
  for (int round = 0; round < completions; ++round) {
    realign();
    dropOpenLoops();
    solve(edges_);
    dropLoose();
    dropForeign();
    dropLoose();
  }
}

std::ptrdiff_t ViewCluster::contradiction(std::size_t view, const Eigen::Isometry3d& T_model_view) const {
  const ViewPlacement placement = placedAt(table_.views(), poses_, view, T_model_view, settings_, limits_);
  return placement.against > placement_slack ? placement.opponent : -1;
}

void ViewCluster::toFrameOf(std::size_t view) {
  const Eigen::Isometry3d T_model_old = poseOfItsOwn(table_.views()[view]) * poses_[view]->inverse();
  for (auto& pose : poses_) {
    if (pose) pose = T_model_old * *pose;
  }
}

void ViewCluster::propose(std::size_t view, std::vector<PoseProposal>& proposals) const {
  const Eigen::Vector3d& center = table_.views()[view].center;
  struct Linked {
    std::size_t tied;
    Eigen::Isometry3d T_model_view;
    double score;
  };
  std::vector<Linked> links;
  for (const std::size_t r : table_.of(view)) {
    const std::size_t tied = table_.other(r, view);
    if (poses_[tied]) links.push_back({tied, *poses_[tied] * table_.pose(r, view), table_.at(r).score});
  }
  std::map<std::size_t, double> best_of_all;  // of each tied view: whatever it says
  for (const Linked& link : links) best_of_all[link.tied] = std::max(best_of_all[link.tied], link.score);
  PoseProposal best;
  for (const Linked& seed : links) {
    std::map<std::size_t, const Linked*> agreeing;
    for (const Linked& link : links) {
      if (!nearlySame(link.T_model_view, seed.T_model_view, center, loops_)) continue;
      const Linked*& known = agreeing[link.tied];
      if (known == nullptr || link.score > known->score) known = &link;
    }
    double weight = 0, against = 0;
    for (const auto& [tied, score] : best_of_all) {
      const auto found = agreeing.find(tied);
      (found != agreeing.end() ? weight : against) += found != agreeing.end() ? found->second->score : score;
    }
    if (weight < majority * against) continue;
    if (weight > best.weight) best = {view, seed.T_model_view, weight, agreeing.size()};
  }
  if (best.weight > 0) proposals.push_back(best);
}

std::size_t ViewCluster::confirmations(const PoseProposal& p) const {
  const std::vector<CapturedView>& views = table_.views();
  std::vector<char> confirms(poses_.size(), 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
  for (std::size_t t = 0; t < poses_.size(); ++t) {
    if (!poses_[t]) continue;
    const Eigen::Isometry3d T_t_view = poses_[t]->inverse() * p.T_model_view;
    const ViewRelation relation = relationAt(views[p.view], views[t], T_t_view, settings_, limits_);
    confirms[t] =
        relation.score > 0 && relation.determined && nearlySame(T_t_view, relation.T_b_a, views[p.view].center, loops_);
  }
  return std::size_t(std::count(confirms.begin(), confirms.end(), 1));
}

std::vector<PoseEdge> ViewCluster::agreeingEdges() const {
  std::vector<PoseEdge> edges;
  for (std::size_t a = 0; a < poses_.size(); ++a) {
    for (std::size_t b = a + 1; b < poses_.size(); ++b) {
      if (!poses_[a] || !poses_[b]) continue;
      const Eigen::Isometry3d T_b_a = poses_[b]->inverse() * *poses_[a];
      for (const std::size_t r : table_.of(a, b)) {
        const ViewRelation& relation = table_.at(r);
        const LoopLimits wide{2 * loops_.angle, 2 * loops_.shift};  // what drifted may still come together
        if (!nearlySame(T_b_a, relation.T_b_a, table_.views()[a].center, wide)) continue;
        edges.push_back({a, b, relation.T_b_a, relation.information});
        break;
      }
    }
  }
  return edges;
}

void ViewCluster::solve(const std::vector<PoseEdge>& edges) {
  if (size() == 0) return;
  std::vector<PoseNode> nodes;
  std::vector<std::size_t> node_of(poses_.size(), 0), view_of;
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    if (!poses_[v]) continue;
    node_of[v] = nodes.size();
    view_of.push_back(v);
    nodes.push_back({*poses_[v], table_.views()[v].center, table_.views()[v].plane});
  }
  std::vector<PoseEdge> among_nodes = edges;
  for (PoseEdge& edge : among_nodes) {
    edge.a = node_of[edge.a];
    edge.b = node_of[edge.b];
  }
  const std::vector<Eigen::Isometry3d> solved = optimizedPoses(nodes, among_nodes, node_of[view_of.front()]);
  for (std::size_t k = 0; k < solved.size(); ++k) poses_[view_of[k]] = solved[k];
}

}  // namespace sks
