// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/registration.hpp>
#include <sks_detector/settings.hpp>

#include "core/registration/relation_table.hpp"
#include "core/registration/upright_pair.hpp"
#include "core/registration/view_relation.hpp"

namespace sks {

/// The views of one object that were tied to each other.
struct TiedViews {
  std::vector<std::optional<Eigen::Isometry3d>> T_model_view;  ///< of each view; none: it could not be tied
  std::vector<std::string> reasons;  ///< why not, in words, other views by their `source`; empty for tied ones
  std::optional<std::size_t> first;  ///< a tied view that the frame was taken from; none: nothing was tied
  /// The middle of the box of what that view shows, as it was when the frame began: views that are added later, even
  /// if they leave that view out, do not move it. Model frame [m].
  Eigen::Vector3d first_middle = Eigen::Vector3d::Zero();
  LoopErrors loops;
  std::optional<Symmetry> symmetry;  ///< under which all views look the same: no turn under it is wrong
};

/// What is known of the views of an object, two by two.
struct PairwiseKnowledge {
  std::vector<ViewRelation> relations;  ///< of relateViews(), of all pairs, unless all views are on known planes
  std::vector<UprightPair> upright;     ///< of compareUpright(), of all pairs of views on known planes
};

/// Ties views on known planes by putting all of them together at once (assembledUpright()); those whose turn stays open
/// are let go. Ties others by their relative poses. A relative pose is believed only together with others that close a
/// loop with it, and only while what the cameras saw of the whole agrees; the poses of all are then optimised together.
/// Where planes are known, they lie in z = 0 of the model and its x axis points to where the first view was taken from;
/// else the model frame is that of the first view. The first view is that of registerViews(). Deterministic for any
/// number of threads.
TiedViews tieViews(const std::vector<CapturedView>& views, const PairwiseKnowledge& pairs, const Settings& settings,
                   const PairLimits& limits, const LoopLimits& loops, int threads);

}  // namespace sks
