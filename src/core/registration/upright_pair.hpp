// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/view_evidence.hpp"

namespace sks {

constexpr std::size_t pair_turns = 72;  ///< about the vertical, 5 degrees apart

/// A relative pose of two views on known planes, at which their surfaces fall on each other.
struct UprightAlternative {
  Eigen::Isometry3d T_b_a = Eigen::Isometry3d::Identity();
  double gain = 0;     ///< see UprightPair::gainOf()
  double overlap = 0;  ///< as in ViewEvidence
};

/// Two views that stood on known planes: what they say to each turn about the vertical.
struct UprightPair {
  std::size_t a = 0, b = 0;  ///< indices of the views, a < b
  /// What a matched patch says at best in shape: surfaces that fall on each other are no reason for a turn, since
  /// objects have sides that are alike, but those that do not are one against it.
  double best_shape = 0;
  UsualPrints usual;
  std::optional<double> known_turn;  ///< of a against b, by how the camera was moved [rad]
  /// By the turn of a against b, each view seen from its camera in the direction of x at turn 0.
  std::array<UprightAlternative, pair_turns> at_turn;

  /// What the alternatives near a turn of a against b say at best. @param turn [rad]
  double bestGainNear(double turn) const;
  /// What evidence says for a pose [log-likelihood ratio]; 0: nothing. Prints count where the turn is not known.
  double gainOf(const ViewEvidence& evidence) const;
  struct Gain {
    double all = 0;
    double shape = 0;     ///< without prints
    double pictures = 0;  ///< without the motion of the camera
  };
  /// The same of a pose. @param views of all pairs
  Gain gainsAt(const std::vector<CapturedView>& views, const Eigen::Isometry3d& T_b_a,
               const VerificationSettings& settings) const;
  double gainAt(const std::vector<CapturedView>& views, const Eigen::Isometry3d& T_b_a,
                const VerificationSettings& settings) const;
  /// What the motion of the camera says to a turn of a against b; 0: nothing. @param turn [rad]
  double motionGain(double turn) const;
};

/// The pose of a view before anything is known of others: where its plane is known, z is the plane's normal, x points
/// to the camera and the origin lies on the plane below the middle of what it shows; else that of its camera.
Eigen::Isometry3d poseOfItsOwn(const CapturedView& view);

/// Angle of the turn about the vertical that a motion of upright poses has [rad].
double turnOf(const Eigen::Isometry3d& motion);

/// Compares two views on known planes at all turns. Deterministic; thread-safe.
UprightPair compareUpright(const std::vector<CapturedView>& views, std::size_t a, std::size_t b,
                           const VerificationSettings& settings);

}  // namespace sks
