// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <sks_detector/settings.hpp>

#include "core/registration/captured_view.hpp"
#include "core/registration/upright_alignment.hpp"
#include "core/registration/upright_pair.hpp"

namespace sks {

/// What is not known of the turns of views that were put together.
struct TurnAmbiguity {
  /// Of each view: by how much it could be turned about the vertical, alone or with some of the others, and fit the
  /// rest as well [rad]; none: its turn is known, or it has no pose.
  std::vector<std::optional<double>> other_turn;
  /// All views fit all others as well when they are turned by 360 / order degrees; 1: they do not.
  int order = 1;
};

/// Looks for turns of single views and groups of them that what all cameras saw does not refute. A turn that no view
/// refutes is a symmetry of the object, as far as it was seen, and no ambiguity. Deterministic for any number of
/// threads.
/// @param poses z upwards
TurnAmbiguity findOtherTurns(const std::vector<CapturedView>& views, const ViewPoses& poses,
                             const std::vector<UprightPair>& pairs, const VerificationSettings& settings, int threads);

}  // namespace sks
