// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_placement.hpp"

#include <algorithm>

namespace sks {
namespace {

constexpr std::size_t placed_points = 800;  // of a view, that are compared

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

}  // namespace sks
