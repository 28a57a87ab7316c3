// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/view_agreement.hpp"
#include "core/registration/view_alignment.hpp"

namespace sks {

/// A relative pose of two views that what they saw allows. Not all of them are right: surfaces that look alike, or the
/// same from several sides, allow several.
struct ViewRelation {
  std::size_t a = 0, b = 0;  ///< indices of the views, a < b
  Eigen::Isometry3d T_b_a = Eigen::Isometry3d::Identity();
  MotionInformation information;
  Uncertainty uncertainty;
  ViewAgreement agreement;
  double deviation = 0;     ///< as in Alignment
  double score = 0;         ///< to compare alternatives
  bool determined = false;  ///< in all six directions
};

/// What a relative pose of two views must be like to be believed.
struct PairLimits {
  double most_contradicted = 0.04;                    ///< fraction of the points
  double least_overlap = 0.2;                         ///< of the smaller view
  double least_color = 0.87;                          ///< share of the matched points whose colours agree
  double largest_turn_deviation = 0.0175;             ///< of a determined pair [rad], 1 degree
  double largest_shift_deviation = 0.003;             ///< [m]
  double plane_angle = 0.0524, plane_height = 0.005;  ///< between the supporting planes, 3 degrees [rad], [m]
  std::size_t most_alternatives = 4;
};

/// The relative pose that alignment finds from a pose that is about right. Its score is 0 where what the cameras saw
/// does not allow it.
ViewRelation relationAt(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                        const Settings& settings, const PairLimits& limits);

/// The relative poses of two views, best first. First poses come from single correspondences of descriptors, in both
/// directions; they are aligned on the dense surfaces and compared in what each camera saw. Deterministic; thread-safe.
std::vector<ViewRelation> relateViews(const CapturedView& a, const CapturedView& b, const Settings& settings,
                                      const PairLimits& limits);

}  // namespace sks
