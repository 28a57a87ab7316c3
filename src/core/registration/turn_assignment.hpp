// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/registration/upright_pair.hpp"

namespace sks {

/// The turns of all views that what their pairs say agrees with best, in steps of UprightPair::at_turn, up to a common
/// one. Grown from each pair in turn, view by view, the one that is told best first; then single views and groups of
/// them are turned as long as that gains anything. The best result counts. Deterministic.
/// @param pairs of all views, in any order
std::vector<std::size_t> assignedTurns(std::size_t views, const std::vector<UprightPair>& pairs);

}  // namespace sks
