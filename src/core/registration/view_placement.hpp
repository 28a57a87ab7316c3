// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/upright_alignment.hpp"
#include "core/registration/view_relation.hpp"

namespace sks {

/// What the views of a model say about the pose of one more.
struct ViewPlacement {
  Eigen::Isometry3d T_model_view = Eigen::Isometry3d::Identity();
  /// What the view that speaks most against it contradicts, of points or colours, over what limits allow.
  double against = 0;
  std::ptrdiff_t opponent = -1;  ///< that view; -1: none
  double overlap = 0;            ///< with the view that shares most, in [0, 1]
  double support = 0;            ///< points that views of the model share with it in their colours
};

/// @param view whose own pose among `poses` does not count
ViewPlacement placedAt(const std::vector<CapturedView>& views, const ViewPoses& poses, std::size_t view,
                       const Eigen::Isometry3d& T_model_view, const Settings& settings, const PairLimits& limits);

}  // namespace sks
