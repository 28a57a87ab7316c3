// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

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

/// How well the prints of two views agree where they meet, on average over all turns about the vertical. What does not
/// depend on the turn, like rings around a can or the noise of sensor and light, says nothing of it.
class UsualPrints {
public:
  /// @param log_likelihood of a patch in some turn
  void add(double log_likelihood) {
    sum_ += log_likelihood;
    count_ += 1;
  }
  /// 0 where nothing is known.
  double mean() const { return count_ > 0 ? sum_ / count_ : 0; }

private:
  double sum_ = 0, count_ = 0;
};

/// Two views that are compared in many poses. Refers to them. Thread-safe, but for learning.
class ViewComparison {
public:
  ViewComparison(const CapturedView& a, const CapturedView& b, const VerificationSettings& settings)
      : a_(a), b_(b), settings_(settings) {}

  /// Both views are looked for in each other.
  ViewEvidence at(const Eigen::Isometry3d& T_b_a, const UsualPrints& usual) const;

  /// Adds what is seen in a pose to what is usual.
  void learn(const Eigen::Isometry3d& T_b_a, UsualPrints& usual) const;

private:
  const CapturedView &a_, &b_;
  const VerificationSettings& settings_;
};

}  // namespace sks
