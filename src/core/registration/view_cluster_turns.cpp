// SPDX-License-Identifier: BSD-3-Clause
// Views that stood on known planes: all that is not known of them is a turn about the vertical and a place on the
// plane.
#include <algorithm>
#include <cmath>

#include "core/registration/view_cluster.hpp"

namespace sks {
namespace {

// 30 degrees, two steps of the search, and what they move the middle of a view by: alignment does not always come back
// from there.
constexpr LoopLimits same_turn{0.5236, 0.03};

double turnOf(const Eigen::Isometry3d& motion) {
  return std::atan2(motion.linear()(1, 0), motion.linear()(0, 0));
}

}  // namespace

std::optional<double> ViewCluster::findOtherTurn(std::size_t view) const {
  const std::vector<CapturedView>& views = table_.views();
  for (const ViewPlacement& placement :
       uprightPlacements(views, poses_, view, *poses_[view], settings_, limits_, placement_slack)) {
    if (nearlySame(placement.T_model_view, *poses_[view], views[view].center, same_turn)) continue;
    if (placement.overlap < limits_.least_overlap) continue;  // where nothing is shared, nothing looks the same
    return turnOf(placement.T_model_view * poses_[view]->inverse());
  }
  return std::nullopt;
}

void ViewCluster::dropAmbiguous() {
  for (std::size_t step = 0; step < poses_.size(); ++step) {  // each drops some: what they said of others is gone too
    std::vector<std::optional<double>> turns(poses_.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
    for (std::size_t v = 0; v < poses_.size(); ++v) {
      if (poses_[v]) turns[v] = findOtherTurn(v);
    }
    bool dropped = false;
    for (std::size_t v = 0; v < poses_.size(); ++v) {
      if (!turns[v]) continue;
      poses_[v].reset();
      other_turns_[v] = turns[v];
      dropped = true;
    }
    if (!dropped) return;
    dropLoose();
  }
}

}  // namespace sks
