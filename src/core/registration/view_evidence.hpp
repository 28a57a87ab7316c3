// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"

namespace sks {

/// What two views say for and against a relative pose, in log-likelihoods: of independent patches of the surface, not
/// of points.
struct ViewEvidence {
  double matched = 0;  ///< patches of either view that the other one saw there, with that normal
  double shape = 0;    ///< of these: how well the surfaces fall on each other, 0 for the noise of the sensor
  double color = 0;    ///< of these: how much better the prints agree than is usual
  double against = 0;  ///< patches that the other camera would have seen elsewhere, or beside what it saw
  double overlap = 0;  ///< part of the smaller view that both saw, in [0, 1]
};

/// How well the print of each compared point of one view agrees with what the other one shows at its place, on average
/// over all turns about the vertical. What does not depend on the turn, like rings around a can or the noise of sensor
/// and light, says nothing of it; nor does a colour that is everywhere.
class UsualPrints {
public:
  /// @param log_likelihood of a point's print in some turn
  void add(std::size_t point, double log_likelihood);
  /// 0 where nothing is known of the point.
  double at(std::size_t point) const;

private:
  std::vector<float> sums_, counts_;
};

/// Two views that are compared in many poses. Refers to them. Thread-safe, but for learning.
class ViewComparison {
public:
  ViewComparison(const CapturedView& a, const CapturedView& b, const VerificationSettings& settings)
      : a_(a), b_(b), settings_(settings) {}

  /// Both views are looked for in each other. @param usual of the points of a in b, and of b in a
  ViewEvidence at(const Eigen::Isometry3d& T_b_a, const UsualPrints& usual_a, const UsualPrints& usual_b) const;

  /// Adds what is seen in a pose to what is usual.
  void learn(const Eigen::Isometry3d& T_b_a, UsualPrints& usual_a, UsualPrints& usual_b) const;

private:
  const CapturedView &a_, &b_;
  const VerificationSettings& settings_;
};

}  // namespace sks
