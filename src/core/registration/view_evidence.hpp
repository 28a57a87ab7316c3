// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"

namespace sks {

/// What two views say for and against a relative pose, in log-likelihoods: of independent patches of the surface, not of
/// points.
struct ViewEvidence {
  double matched = 0;  ///< patches of either view that the other one saw there, with that normal
  double shape = 0;    ///< of these: how well the surfaces fall on each other, 0 for the noise of the sensor
  double color = 0;    ///< of these: how well the prints agree, 0 at best
  double against = 0;  ///< patches that the other camera would have seen elsewhere, or beside what it saw
  double overlap = 0;  ///< part of the smaller view that both saw, in [0, 1]
};

/// Both views are looked for in each other. @param points of each view that are looked for, about
ViewEvidence evidenceFor(const CapturedView& a, const CapturedView& b, const Eigen::Isometry3d& T_b_a,
                         const VerificationSettings& settings, std::size_t points);

}  // namespace sks
