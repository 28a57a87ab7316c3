// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sks_detector/registration.hpp>
#include <sks_detector/settings.hpp>

#include "core/registration/model_axes.hpp"
#include "core/registration/relation_table.hpp"
#include "core/registration/upright_pair.hpp"
#include "core/registration/view_relation.hpp"

namespace sks {

/// The views of one object that were tied to each other.
struct TiedViews {
  ViewPoses T_model_view;            ///< of each view; none: it could not be tied
  std::vector<std::string> reasons;  ///< why not, in words, other views by their `source`; empty for tied ones
  std::optional<ModelAxes> axes;     ///< none: nothing was tied
  LoopErrors loops;
  std::optional<Symmetry> symmetry;  ///< under which all views look the same: no turn under it is wrong
};

/// What is known of the views of an object, two by two.
struct PairwiseKnowledge {
  std::vector<ViewRelation> relations;  ///< of relateViews(), of all pairs, unless all views are on known planes
  std::vector<UprightPair> upright;     ///< of compareUpright(), of all pairs of views on known planes
};

/// Of the first views, so many as its index: how they were tied when there were no others. It saves what was found
/// when the same views are tied again with others after them.
using EarlierTies = std::vector<std::optional<ViewPoses>>;

/// Ties views on known planes by putting all of them together at once (assembledUpright()); those whose turn stays open
/// are let go. Ties others by their relative poses. A relative pose is believed only together with others that close a
/// loop with it, and only while what the cameras saw of the whole agrees; the poses of all are then optimised together.
/// Where planes are known, they lie in z = 0 of the model and its x axis points to where the first view was taken from;
/// else the model frame is that of the first view. The first view is that of orientModel(). Deterministic for any
/// number of threads.
/// @param earlier of the same views; what is found is added
TiedViews tieViews(const std::vector<CapturedView>& views, const PairwiseKnowledge& pairs, const Settings& settings,
                   const PairLimits& limits, const LoopLimits& loops, int threads, EarlierTies& earlier);

}  // namespace sks
