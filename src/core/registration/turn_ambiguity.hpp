// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/upright_alignment.hpp"
#include "core/registration/upright_pair.hpp"

namespace sks {

/// Views of a model that could be turned about the vertical together, against all others.
struct OtherTurn {
  std::vector<std::size_t> views;                            ///< in ascending order; at most half of all
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< of their poses
  double loss = 0;        ///< of what all pairs say for the poses, if they are moved [log-likelihood ratio]
  double shape_loss = 0;  ///< of the loss, what prints have no part in
  double largest = 0;     ///< what the pair loses that loses most
  double squares = 0;     ///< sum of the squares of what each pair loses
  std::size_t pairs = 0;  ///< of a view that is moved and one that stays

  double angle() const { return turnOf(motion); }
  /// Whether the views would not be nearly as they are.
  bool isOther() const;
  /// Whether what the cameras saw speaks against it: clearly, and not by what a single pair of views tells: for
  /// k pairs that lose alike, loss * loss / squares is k.
  bool isRefuted() const;
};

/// What is not known of the turns of views that were put together.
struct TurnAmbiguity {
  /// Of each turn that was tried, 10 degrees apart, the one that loses least; none: all fit as well, or nothing comes
  /// near. Among them are some that hardly turn, isOther() is false: views that fit a little better beside their place.
  std::vector<std::optional<OtherTurn>> others;
  /// All views fit all others as well when they are turned by 360 / order degrees; 1: they do not.
  int order = 1;

  /// The one that gains most; none: none gains anything worth a move.
  const OtherTurn* best() const;
};

/// Looks for turns of single views and groups of them that what all cameras saw does not refute. A turn that no view
/// refutes is a symmetry of the object, as far as it was seen, and no ambiguity. Deterministic for any number of
/// threads.
/// @param poses z upwards
TurnAmbiguity findOtherTurns(const std::vector<CapturedView>& views, const ViewPoses& poses,
                             const std::vector<UprightPair>& pairs, const VerificationSettings& settings, int threads);

}  // namespace sks
