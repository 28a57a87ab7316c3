// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/registration/view_relation.hpp"

namespace sks {

/// When relative poses close a loop.
struct LoopLimits {
  double angle = 0.0524;  ///< [rad], 3 degrees
  double shift = 0.005;   ///< [m], at the middle of what a view shows
};

/// Angle of the rotation between two poses [rad].
double angleBetween(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other);

/// Whether two poses differ by no more than the limits, at a centre.
bool nearlySame(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other, const Eigen::Vector3d& center,
                const LoopLimits& limits);

/// The relations of each pair of views, by number. Refers to views and relations; thread-safe.
class RelationTable {
public:
  RelationTable(const std::vector<CapturedView>& views, const std::vector<ViewRelation>& relations)
      : views_(views), relations_(relations), of_view_(views.size()) {
    for (std::size_t r = 0; r < relations.size(); ++r) {
      if (!relations[r].determined) continue;
      of_pair_[{relations[r].a, relations[r].b}].push_back(r);
      of_view_[relations[r].a].push_back(r);
      of_view_[relations[r].b].push_back(r);
    }
  }

  const std::vector<std::size_t>& of(std::size_t view) const { return of_view_[view]; }
  const std::vector<std::size_t>& of(std::size_t a, std::size_t b) const {
    static const std::vector<std::size_t> none;
    const auto found = of_pair_.find({std::min(a, b), std::max(a, b)});
    return found == of_pair_.end() ? none : found->second;
  }
  const ViewRelation& at(std::size_t r) const { return relations_[r]; }
  std::size_t other(std::size_t r, std::size_t view) const {
    return relations_[r].a == view ? relations_[r].b : relations_[r].a;
  }
  /// The pose of `from` in the frame of `to`.
  Eigen::Isometry3d pose(std::size_t r, std::size_t from) const {
    return relations_[r].a == from ? relations_[r].T_b_a : relations_[r].T_b_a.inverse();
  }
  const std::vector<CapturedView>& views() const { return views_; }

private:
  const std::vector<CapturedView>& views_;
  const std::vector<ViewRelation>& relations_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> of_pair_;
  std::vector<std::vector<std::size_t>> of_view_;
};

/// Three relations that close a loop.
struct ViewLoop {
  std::size_t i, j, k;     // views
  std::size_t ij, jk, ik;  // relations
  double weight;
};

/// All loops that close, those of the best relations first.
std::vector<ViewLoop> closedLoops(const RelationTable& table, const LoopLimits& limits);

}  // namespace sks
