// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/turn_ambiguity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>

namespace sks {
namespace {

constexpr std::size_t other_turns = 36;                               // 10 degrees apart
constexpr double refuting = 80;                                       // least loss of a group that is turned wrongly
constexpr double other_turn_limit = 0.14;                             // [rad] 8 degrees: nearer ones are the same turn
constexpr UprightRounds whole_rounds{2, 6, 0.025, 0.008, 50, false};  // of the whole model on itself
constexpr UprightRounds group_rounds{2, 6, 0.025, 0.008, 80, false};  // of a group on the rest
constexpr double worth_aligning = 1000;                               // loss of a group before it is aligned
constexpr int highest_order = 8;

/// A group that could be turned.
struct TurnedGroup {
  std::vector<std::size_t> views;
  double loss = std::numeric_limits<double>::infinity();
};

class OtherTurns {
public:
  OtherTurns(const std::vector<CapturedView>& views, const ViewPoses& poses, const std::vector<UprightPair>& pairs,
             const VerificationSettings& settings)
      : views_(views), poses_(poses), settings_(settings), pair_of_(views.size() * views.size(), nullptr) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      if (poses[v]) tied_.push_back(v);
    }
    for (const UprightPair& pair : pairs) {
      pair_of_[pair.a * views.size() + pair.b] = &pair;
      pair_of_[pair.b * views.size() + pair.a] = &pair;
    }
    Eigen::AlignedBox3d box;
    for (const std::size_t v : tied_) {
      for (std::size_t i = 0; i < views[v].points.size(); ++i)
        box.extend(*poses[v] * views[v].points.point(i).cast<double>());
    }
    middle_ = box.center();
  }

  /// What the cheapest group loses at a turn, aligned, and its turn then; and what the most reluctant single view does.
  struct Result {
    TurnedGroup group;
    double turn = 0;
    bool all_fit = false;
  };

  Result at(std::size_t turn) const {
    const Eigen::AngleAxisd turned(2 * double(EIGEN_PI) * double(turn) / double(other_turns), Eigen::Vector3d::UnitZ());
    const Eigen::Isometry3d start = Eigen::Translation3d(middle_) * turned * Eigen::Translation3d(-middle_);
    const Eigen::Isometry3d whole = alignedMotion(views_, poses_, tied_, tied_, start, whole_rounds);
    Result result;
    std::set<std::vector<std::size_t>> groups;
    const std::vector<double> losses = lossesBy(whole);
    result.all_fit = isOther(whole);
    for (const std::size_t v : tied_) {
      double loss = 0;
      for (const std::size_t t : tied_) loss += losses[v * views_.size() + t];
      result.all_fit = result.all_fit && loss <= refuting;
      const TurnedGroup group = grownFrom(v, losses);
      if (group.loss <= worth_aligning) groups.insert(group.views);
    }
    for (const std::vector<std::size_t>& group : groups) consider({group, 0}, whole, result);
    // alone, a view may fit where the whole does not
    for (const std::size_t v : tied_) consider({{v}, 0}, start, result);
    return result;
  }

private:
  static bool isOther(const Eigen::Isometry3d& motion) { return std::abs(turnOf(motion)) > other_turn_limit; }

  double gain(std::size_t v, const Eigen::Isometry3d& T_v, std::size_t t, const Eigen::Isometry3d& T_t) const {
    const UprightPair& pair = *pair_of_[v * views_.size() + t];
    const Eigen::Isometry3d T_t_v = T_t.inverse() * T_v;
    return pair.gainAt(views_, pair.a == v ? T_t_v : T_t_v.inverse(), settings_);
  }

  /// What each pair loses if the first view of it is moved.
  std::vector<double> lossesBy(const Eigen::Isometry3d& motion) const {
    std::vector<double> losses(views_.size() * views_.size(), 0);
    for (const std::size_t v : tied_) {
      for (const std::size_t t : tied_) {
        if (t == v) continue;
        losses[v * views_.size() + t] =
            gain(v, *poses_[v], t, *poses_[t]) - gain(v, motion * *poses_[v], t, *poses_[t]);
      }
    }
    return losses;
  }

  /// The group that loses least of those that grow from a view by one that loses least after the other.
  TurnedGroup grownFrom(std::size_t first, const std::vector<double>& losses) const {
    std::vector<char> in(views_.size(), 0);
    std::vector<std::size_t> members;
    TurnedGroup best;
    double loss = 0;
    std::size_t next = first;
    const auto change = [&](std::size_t v) {
      double sum = 0;
      for (const std::size_t t : tied_) {
        if (t != v) sum += in[t] ? -losses[t * views_.size() + v] : losses[v * views_.size() + t];
      }
      return sum;
    };
    for (std::size_t size = 1; size < tied_.size(); ++size) {
      loss += change(next);
      in[next] = 1;
      members.push_back(next);
      if (loss < best.loss) best = {members, loss};
      double least = std::numeric_limits<double>::infinity();
      for (const std::size_t v : tied_) {
        if (in[v] || change(v) >= least) continue;
        least = change(v);
        next = v;
      }
    }
    std::sort(best.views.begin(), best.views.end());
    return best;
  }

  /// Aligned with the rest.
  void consider(const TurnedGroup& group, const Eigen::Isometry3d& start, Result& result) const {
    std::vector<std::size_t> rest;
    for (const std::size_t t : tied_) {
      if (std::find(group.views.begin(), group.views.end(), t) == group.views.end()) rest.push_back(t);
    }
    const Eigen::Isometry3d motion = alignedMotion(views_, poses_, group.views, rest, start, group_rounds);
    if (!isOther(motion)) return;
    double loss = 0;
    for (const std::size_t v : group.views) {
      for (const std::size_t t : rest) {
        loss += gain(v, *poses_[v], t, *poses_[t]) - gain(v, motion * *poses_[v], t, *poses_[t]);
      }
    }
    if (loss >= result.group.loss) return;
    result.group = {2 * group.views.size() <= tied_.size() ? group.views : rest, loss};
    result.turn = turnOf(motion);
  }

  const std::vector<CapturedView>& views_;
  const ViewPoses& poses_;
  const VerificationSettings& settings_;
  std::vector<const UprightPair*> pair_of_;
  std::vector<std::size_t> tied_;
  Eigen::Vector3d middle_;
};

}  // namespace

TurnAmbiguity findOtherTurns(const std::vector<CapturedView>& views, const ViewPoses& poses,
                             const std::vector<UprightPair>& pairs, const VerificationSettings& settings, int threads) {
  const OtherTurns search(views, poses, pairs, settings);
  std::vector<OtherTurns::Result> results(other_turns);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t turn = 1; turn < other_turns; ++turn) results[turn] = search.at(turn);
  TurnAmbiguity ambiguity;
  ambiguity.other_turn.resize(views.size());
  for (int order = 2; order <= highest_order; ++order) {
    if (other_turns % std::size_t(order) != 0) continue;
    bool all = true;
    for (std::size_t k = 1; k < std::size_t(order); ++k)
      all = all && results[k * other_turns / std::size_t(order)].all_fit;
    if (all) ambiguity.order = order;
  }
  for (std::size_t turn = 1; turn < other_turns; ++turn) {
    const OtherTurns::Result& result = results[turn];
    if (result.group.loss > refuting || result.all_fit) continue;
    for (const std::size_t v : result.group.views) ambiguity.other_turn[v] = result.turn;
  }
  return ambiguity;
}

}  // namespace sks
