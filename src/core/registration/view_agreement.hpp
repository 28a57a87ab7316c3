// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"

namespace sks {

/// What two cameras saw of one object, compared in a relative pose. Counts are numbers of thinned points, of both views
/// together, each looked for in the other.
struct ViewAgreement {
  double points = 0;    ///< looked for
  double facing = 0;    ///< that the other camera could have seen, as far as nothing hid them
  double matched = 0;   ///< that it saw there, with that normal
  double in_front = 0;  ///< through which it looked at something else
  double outside = 0;   ///< that it would have seen beside the object
  double least = 0;     ///< points of the smaller view
  /// Share of the matched points whose colour the other camera saw there or beside it, but for what exposure moves all
  /// colours by; 1 without colour.
  double color = 1;

  /// Fraction of the points that cannot be where the pose puts them.
  double contradicted() const { return points > 0 ? (in_front + outside) / points : 1; }
  /// Part of the smaller view that both cameras saw, in [0, 1].
  double overlap() const { return least > 0 ? 0.5 * matched / least : 0; }
};

/// @param T_b_a the pose of view a in the frame of view b
/// @param stride every so many points are looked for
ViewAgreement compareViews(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                           const VerificationSettings& settings, std::size_t stride = 1);

}  // namespace sks
