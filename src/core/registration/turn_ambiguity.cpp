// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/turn_ambiguity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace sks {
namespace {

constexpr std::size_t other_turns = 36;    // 10 degrees apart, and half a step to each side
constexpr double refuting = 80;            // least loss of a group that is turned wrongly
constexpr double refuting_by_shape = 40;   // least loss without prints: those of plain things are light and noise
constexpr double refuting_pairs = 2;       // as many have to tell it
constexpr double least_gain_of_move = 5;   // of moving views to where they fit better
constexpr double other_turn_limit = 0.14;  // [rad] 8 degrees: nearer ones are the same turn
constexpr double least_turn = 0.03;        // [rad] of a move
constexpr double clearly_refuted = 4;      // times the least loss: of what is lost by the best poses of all pairs
constexpr UprightRounds whole_rounds{2, 6, 0.025, 0.008, 50, false};  // of the whole model on itself
constexpr UprightRounds group_rounds{2, 6, 0.025, 0.008, 80, false};  // of a group on the rest
constexpr double worth_aligning = 1000;                               // loss of a group before it is aligned
constexpr std::size_t most_groups = 8;  // of a turn that are aligned: those that lose least
constexpr int highest_order = 8;

using Group = std::vector<std::size_t>;

class OtherTurns {
public:
  OtherTurns(const std::vector<CapturedView>& views, const ViewPoses& poses, const std::vector<UprightPair>& pairs,
             const VerificationSettings& settings)
      : views_(views),
        poses_(poses),
        settings_(settings),
        pair_of_(views.size() * views.size(), nullptr),
        gains_(views.size() * views.size()),
        headings_(views.size(), 0) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      if (poses[v]) tied_.push_back(v);
    }
    for (const UprightPair& pair : pairs) {
      pair_of_[pair.a * views.size() + pair.b] = &pair;
      pair_of_[pair.b * views.size() + pair.a] = &pair;
    }
    Eigen::AlignedBox3d box;
    for (const std::size_t v : tied_) {
      headings_[v] = turnOf(*poses[v] * poseOfItsOwn(views[v]).inverse());
      for (std::size_t i = 0; i < views[v].points.size(); ++i)
        box.extend(*poses[v] * views[v].points.point(i).cast<double>());
      for (const std::size_t t : tied_) {
        if (t != v) gains_[v * views.size() + t] = gain(v, *poses[v], t, *poses[t]);
      }
    }
    middle_ = box.center();
  }

  struct Result {
    std::optional<OtherTurn> least;  // loses least
    bool all_fit = false;            // of all views, each by itself
  };

  Result at(double turn) const {
    const Eigen::AngleAxisd turned(turn, Eigen::Vector3d::UnitZ());
    const Eigen::Isometry3d start = Eigen::Translation3d(middle_) * turned * Eigen::Translation3d(-middle_);
    const Eigen::Isometry3d whole = alignedMotion(views_, poses_, tied_, tied_, start, whole_rounds);
    Result result;
    std::map<Group, double> grown;  // and what they lose
    const std::vector<UprightPair::Gain> losses = lossesBy(whole);
    result.all_fit = std::abs(turnOf(whole)) > other_turn_limit;
    for (const std::size_t v : tied_) {
      double loss = 0;
      for (const std::size_t t : tied_) loss += losses[v * views_.size() + t].pictures;
      result.all_fit = result.all_fit && loss <= refuting;
      auto [group, group_loss] = grownFrom(v, losses);
      if (!group.empty() && leastLoss(group, turn) < clearly_refuted * refuting)
        grown.emplace(std::move(group), group_loss);
    }
    std::vector<std::pair<double, const Group*>> groups;
    for (const auto& [group, group_loss] : grown) groups.emplace_back(group_loss, &group);
    std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    groups.resize(std::min(groups.size(), most_groups));
    for (const auto& [group_loss, group] : groups) consider(*group, whole, result);
    // alone, a view may fit where the whole does not
    for (const std::size_t v : tied_) {
      if (leastLoss({v}, turn) < clearly_refuted * refuting) consider({v}, start, result);
    }
    return result;
  }

private:
  UprightPair::Gain gain(std::size_t v, const Eigen::Isometry3d& T_v, std::size_t t,
                         const Eigen::Isometry3d& T_t) const {
    const UprightPair& pair = *pair_of_[v * views_.size() + t];
    const Eigen::Isometry3d T_t_v = T_t.inverse() * T_v;
    return pair.gainsAt(views_, pair.a == v ? T_t_v : T_t_v.inverse(), settings_);
  }

  /// What a pair loses if the first view of it is moved.
  UprightPair::Gain lossOf(std::size_t v, std::size_t t, const Eigen::Isometry3d& motion) const {
    const UprightPair::Gain now = gains_[v * views_.size() + t], moved = gain(v, motion * *poses_[v], t, *poses_[t]);
    return {now.all - moved.all, now.shape - moved.shape, now.pictures - moved.pictures};
  }

  /// What a group loses at least at a turn, if each pair could choose its own place there.
  double leastLoss(const Group& group, double turn) const {
    double loss = 0;
    for (const std::size_t v : group) {
      for (const std::size_t t : tied_) {
        if (std::binary_search(group.begin(), group.end(), t)) continue;
        const UprightPair& pair = *pair_of_[v * views_.size() + t];
        const double between = headings_[v] + turn - headings_[t];
        loss += gains_[v * views_.size() + t].all - pair.bestGainNear(pair.a == v ? between : -between);
      }
    }
    return loss;
  }

  std::vector<UprightPair::Gain> lossesBy(const Eigen::Isometry3d& motion) const {
    std::vector<UprightPair::Gain> losses(views_.size() * views_.size());
    for (const std::size_t v : tied_) {
      for (const std::size_t t : tied_) {
        if (t != v) losses[v * views_.size() + t] = lossOf(v, t, motion);
      }
    }
    return losses;
  }

  /// The group that loses least of those that grow from a view by one that loses least after the other, up to half of
  /// all: the rest, turned back, loses the same. Empty if none is worth a look.
  std::pair<Group, double> grownFrom(std::size_t first, const std::vector<UprightPair::Gain>& losses) const {
    std::vector<char> in(views_.size(), 0);
    Group members, best;
    double loss = 0, least_loss = worth_aligning;
    std::size_t next = first;
    const auto change = [&](std::size_t v) {
      double sum = 0;
      for (const std::size_t t : tied_) {
        if (t != v) sum += in[t] ? -losses[t * views_.size() + v].all : losses[v * views_.size() + t].all;
      }
      return sum;
    };
    while (2 * (members.size() + 1) <= tied_.size()) {
      loss += change(next);
      in[next] = 1;
      members.push_back(next);
      if (loss < least_loss) {
        least_loss = loss;
        best = members;
      }
      double least = std::numeric_limits<double>::infinity();
      for (const std::size_t v : tied_) {
        if (in[v] || change(v) >= least) continue;
        least = change(v);
        next = v;
      }
    }
    std::sort(best.begin(), best.end());
    return {best, least_loss};
  }

  /// Aligned with the rest.
  void consider(const Group& group, const Eigen::Isometry3d& start, Result& result) const {
    Group rest;
    std::set_difference(tied_.begin(), tied_.end(), group.begin(), group.end(), std::back_inserter(rest));
    OtherTurn other{group, alignedMotion(views_, poses_, group, rest, start, group_rounds)};
    if (std::abs(other.angle()) < least_turn) return;
    for (const std::size_t v : group) {
      for (const std::size_t t : rest) {
        const UprightPair::Gain lost = lossOf(v, t, other.motion);
        other.shape_loss += lost.shape;
        other.loss += lost.all;
        other.largest = std::max(other.largest, lost.all);
        other.squares += lost.all * lost.all;
        ++other.pairs;
      }
    }
    // what is not refuted counts first
    if (result.least &&
        std::make_pair(result.least->isRefuted(), result.least->loss) <= std::make_pair(other.isRefuted(), other.loss))
      return;
    result.least = std::move(other);
  }

  const std::vector<CapturedView>& views_;
  const ViewPoses& poses_;
  const VerificationSettings& settings_;
  std::vector<const UprightPair*> pair_of_;
  std::vector<UprightPair::Gain> gains_;  // of all pairs of tied views
  std::vector<double> headings_;          // of the views [rad]
  Group tied_;
  Eigen::Vector3d middle_;
};

}  // namespace

bool OtherTurn::isOther() const {
  return std::abs(angle()) > other_turn_limit;
}

bool OtherTurn::isRefuted() const {
  const double alike = refuting_pairs * double(pairs - 1) / double(pairs);
  return loss > refuting && shape_loss > refuting_by_shape && loss - largest > refuting / refuting_pairs &&
         loss * loss >= alike * squares;
}

const OtherTurn* TurnAmbiguity::best() const {
  const OtherTurn* best = nullptr;
  for (const std::optional<OtherTurn>& other : others) {
    if (other && other->loss < (best == nullptr ? -least_gain_of_move : best->loss)) best = &*other;
  }
  return best;
}

TurnAmbiguity findOtherTurns(const std::vector<CapturedView>& views, const ViewPoses& poses,
                             const std::vector<UprightPair>& pairs, const VerificationSettings& settings, int threads) {
  const OtherTurns search(views, poses, pairs, settings);
  constexpr double step = 2 * double(EIGEN_PI) / double(other_turns);
  std::vector<double> turns;
  for (std::size_t k = 1; k < other_turns; ++k) turns.push_back(step * double(k));
  turns.insert(turns.end(), {-0.5 * step, 0.5 * step});
  std::vector<OtherTurns::Result> results(turns.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t k = 0; k < turns.size(); ++k) results[k] = search.at(turns[k]);
  TurnAmbiguity ambiguity;
  for (int order = 2; order <= highest_order; ++order) {
    if (other_turns % std::size_t(order) != 0) continue;
    bool all = true;
    for (std::size_t k = 1; k < std::size_t(order); ++k)
      all = all && results[k * other_turns / std::size_t(order) - 1].all_fit;
    if (all) ambiguity.order = order;
  }
  for (const OtherTurns::Result& result : results) {
    ambiguity.others.push_back(result.all_fit ? std::nullopt : result.least);
  }
  return ambiguity;
}

}  // namespace sks
