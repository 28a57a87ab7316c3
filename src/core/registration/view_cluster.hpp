// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/registration.hpp>
#include <sks_detector/settings.hpp>

#include "core/registration/pose_graph.hpp"
#include "core/registration/relation_table.hpp"
#include "core/registration/upright_pair.hpp"
#include "core/registration/view_placement.hpp"

namespace sks {

constexpr std::size_t fewest_edges = 2;  ///< of a tied view: what a single pair says is not believed
constexpr double placement_slack = 1.5;  ///< of the limits of contradictions, for poses that are not optimised yet

/// A pose of a view that is not tied yet, by relations to tied ones.
struct PoseProposal {
  std::size_t view = 0;
  Eigen::Isometry3d T_model_view = Eigen::Isometry3d::Identity();
  double weight = 0;      // of the relations that agree
  std::size_t edges = 0;  // how many
};

/// Views that are tied to each other, beginning with one loop of three (docs/method.md, section 16). Refers to all that
/// it is made of. Deterministic for any number of threads.
class ViewCluster {
public:
  ViewCluster(const RelationTable& table, const Settings& settings, const PairLimits& limits, const LoopLimits& loops,
              int threads)
      : table_(table),
        settings_(settings),
        limits_(limits),
        loops_(loops),
        threads_(threads),
        poses_(table.views().size()),
        foreign_(table.views().size(), 0) {}

  /// Ties the three views of a loop.
  void begin(const ViewLoop& loop);

  /// Ties one view after the other, those that most speaks for first.
  void grow();

  /// Whether no tied view contradicts it, and enough of them confirm it: those that proposed it, or else those that
  /// alignment from the proposed pose brings back to it.
  bool isAllowed(const PoseProposal& p) const;

  /// Aligns all pairs anew from the common poses, drops what does not fit, and optimises again.
  void complete();

  /// Takes views on known planes that were put together otherwise, and optimises their poses by the relations.
  /// @param slack by how many times the usual limits poses may be off
  void adopt(const ViewPoses& poses, double slack);

  /// Drops views that contradict others, and those that show something else besides.
  /// @return of each view that contradicts: the one that it contradicts most; else -1
  std::vector<std::ptrdiff_t> dropContradicted();

  /// Drops views that share too little with the others to be confirmed by two of them.
  void dropUnshared();

  void letGo(std::size_t view) { poses_[view].reset(); }

  std::size_t size() const {
    return std::size_t(std::count_if(poses_.begin(), poses_.end(), [](const auto& pose) { return bool(pose); }));
  }
  double weight() const { return weight_; }
  const ViewPoses& poses() const { return poses_; }
  bool isTied(std::size_t view) const { return bool(poses_[view]); }
  bool isForeign(std::size_t view) const { return foreign_[view] != 0; }
  bool holds(const ViewLoop& loop) const { return poses_[loop.i] && poses_[loop.j] && poses_[loop.k]; }

  LoopErrors loopErrors() const;

  /// The tied view that contradicts a pose most, in shape or colour, if by more than the limits allow; else -1.
  std::ptrdiff_t contradiction(std::size_t view, const Eigen::Isometry3d& T_model_view) const;

  /// The best poses of a view by its relations to tied views, whether they are allowed or not.
  void propose(std::size_t view, std::vector<PoseProposal>& proposals) const;

private:
  std::size_t confirmations(const PoseProposal& p) const;
  void toFrameOf(std::size_t view);
  std::vector<PoseEdge> agreeingEdges() const;
  void optimize() { solve(agreeingEdges()); }
  void solve(const std::vector<PoseEdge>& edges);
  /// Three edges of three views, and by how much they do not close.
  struct EdgeLoop {
    std::array<std::size_t, 3> edges;
    double shift, angle;
  };
  std::vector<EdgeLoop> edgeLoops() const;
  void realign();
  void dropOpenLoops();
  void dropLoose();
  void dropForeign();
  double foreignShare(std::size_t view) const;

  const RelationTable& table_;
  const Settings& settings_;
  const PairLimits& limits_;
  const LoopLimits& loops_;
  int threads_;
  ViewPoses poses_;
  std::vector<PoseEdge> edges_;  // after complete()
  std::vector<double> scores_;   // of the edges
  std::vector<char> foreign_;    // of each view: dropped for what it shows besides
  double weight_ = 0;
};

}  // namespace sks
