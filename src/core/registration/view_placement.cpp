// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_placement.hpp"

#include <algorithm>
#include <cmath>

#include "core/registration/relation_table.hpp"

namespace sks {
namespace {

constexpr int upright_turns = 24;                                 // 15 degrees apart: alignment reaches half as far
constexpr std::size_t placed_points = 800;                        // of a view, that are compared
constexpr double aligning_overlap = 0.5;                          // from which on alignment tells the place
constexpr double fitting_steps[] = {0.016, 0.008, 0.004, 0.002};  // [m]
constexpr int most_moves = 4;                                     // of each step
constexpr LoopLimits same_placement{0.0873, 0.008};               // 5 degrees
constexpr UprightRounds placing_rounds{8, 0.025, 0.008};          // from poses that are off by half a turn step

/// Middle of the box of all views of a model.
Eigen::Vector3d middleOf(const std::vector<CapturedView>& views, const ViewPoses& poses) {
  Eigen::AlignedBox3d box;
  for (std::size_t t = 0; t < views.size(); ++t) {
    for (std::size_t i = 0; poses[t] && i < views[t].points.size(); ++i) {
      box.extend(*poses[t] * views[t].points.point(i).cast<double>());
    }
  }
  return box.center();
}

/// Where little is shared, alignment does not tell the place: shifted and turned to where least is contradicted.
template <typename Placed>
ViewPlacement movedToFit(ViewPlacement best, const CapturedView& view, const Placed& placed, double enough) {
  for (const double step : fitting_steps) {
    for (int move = 0; move < most_moves && best.against > enough; ++move) {
      ViewPlacement next = best;
      const Eigen::Vector3d center = best.T_model_view * view.center;
      for (int way = 0; way < 6; ++way) {  // to both sides along x, along y, and about z
        const double size = way % 2 == 0 ? step : -step;
        const Eigen::Vector3d shift(way / 2 == 0 ? size : 0, way / 2 == 1 ? size : 0, 0);
        const Eigen::AngleAxisd turn(way / 2 == 2 ? size / view.radius : 0, Eigen::Vector3d::UnitZ());
        const ViewPlacement moved =
            placed(Eigen::Translation3d(center + shift) * turn * Eigen::Translation3d(-center) * best.T_model_view);
        if (moved.against < next.against) next = moved;
      }
      if (next.against >= best.against) break;
      best = next;
    }
  }
  return best;
}

}  // namespace

ViewPlacement placedAt(const std::vector<CapturedView>& views, const ViewPoses& poses, std::size_t view,
                       const Eigen::Isometry3d& T_model_view, const Settings& settings, const PairLimits& limits) {
  ViewPlacement placement;
  placement.T_model_view = T_model_view;
  const std::size_t stride = std::max<std::size_t>(1, views[view].points.size() / placed_points);
  for (std::size_t t = 0; t < views.size(); ++t) {
    if (!poses[t] || t == view) continue;
    const ViewAgreement agreement =
        compareViews(views[view], views[t], poses[t]->inverse() * T_model_view, settings.verification, stride);
    const double discolored = agreement.overlap() >= limits.least_overlap ? 1 - agreement.color : 0;
    const double against =
        std::max(agreement.contradicted() / limits.most_contradicted, discolored / (1 - limits.least_color));
    placement.overlap = std::max(placement.overlap, agreement.overlap());
    placement.support += agreement.matched * agreement.color;
    if (against <= placement.against) continue;
    placement.against = against;
    placement.opponent = std::ptrdiff_t(t);
  }
  return placement;
}

std::vector<ViewPlacement> uprightPlacements(const std::vector<CapturedView>& views, const ViewPoses& poses,
                                             std::size_t view, const Eigen::Isometry3d& T_model_view,
                                             const Settings& settings, const PairLimits& limits, double most_against) {
  const Eigen::Vector3d middle = middleOf(views, poses);
  std::vector<ViewPlacement> found;
  for (int turn = 0; turn < upright_turns; ++turn) {
    const Eigen::AngleAxisd turned(2 * double(EIGEN_PI) * turn / upright_turns, Eigen::Vector3d::UnitZ());
    const Eigen::Isometry3d start =
        Eigen::Translation3d(middle) * turned * Eigen::Translation3d(-middle) * T_model_view;
    const Eigen::Isometry3d T = alignedUpright(views, poses, view, start, placing_rounds);
    const auto placed = [&](const Eigen::Isometry3d& at) { return placedAt(views, poses, view, at, settings, limits); };
    ViewPlacement placement = placed(T);
    if (placement.overlap < aligning_overlap) placement = movedToFit(placement, views[view], placed, most_against);
    if (placement.against <= most_against) found.push_back(placement);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const ViewPlacement& x, const ViewPlacement& y) { return x.support > y.support; });
  std::vector<ViewPlacement> distinct;
  for (const ViewPlacement& placement : found) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](const ViewPlacement& other) {
      return nearlySame(placement.T_model_view, other.T_model_view, views[view].center, same_placement);
    });
    if (!known) distinct.push_back(placement);
  }
  return distinct;
}

}  // namespace sks
