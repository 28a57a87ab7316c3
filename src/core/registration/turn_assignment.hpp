// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/registration/upright_pair.hpp"

namespace sks {

/// Turns of all views, in steps of UprightPair::at_turn, up to a common one.
using ViewTurns = std::vector<std::size_t>;

/// The turns of all views that what their pairs say agrees with best, and others that come near, at most so many. Grown
/// from each pair in turn, view by view, the one that is told best first; then single views and groups of them are
/// turned as long as that gains anything. Several, since pairs that share little do not tell their place, and thus say
/// too little for right turns. Deterministic.
/// @param pairs of all views, in any order
/// @return at least one, best first
std::vector<ViewTurns> assignedTurns(std::size_t views, const std::vector<UprightPair>& pairs, std::size_t most);

}  // namespace sks
