// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/upright_assembly.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "core/registration/turn_assignment.hpp"

namespace sks {
namespace {

// From sweep to sweep views are turned by less [rad], to find what prints tell beyond the shape.
constexpr double turn_steps[] = {0.105, 0.052, 0.026, 0.013, 0.013};
constexpr std::size_t first_sweeps = 2;      // before the best assignment is chosen
constexpr std::size_t most_assignments = 6;  // of turns, that are looked at
constexpr double least_move_gain = 0.5;
constexpr UprightRounds moving_rounds{0, 4, 0.012, 0.006, 150, false};

class Assembly {
public:
  Assembly(const std::vector<CapturedView>& views, const std::vector<UprightPair>& pairs,
           const VerificationSettings& settings)
      : views_(views), pairs_(pairs), settings_(settings), poses_(views.size()) {}

  ViewPoses assembled() {
    ViewPoses best;
    double most = -std::numeric_limits<double>::infinity();
    for (const ViewTurns& turns : assignedTurns(views_.size(), pairs_, most_assignments)) {
      poses_.assign(views_.size(), std::nullopt);
      place(turns);
      for (std::size_t sweep = 0; sweep < first_sweeps; ++sweep) moveAll(turn_steps[sweep]);
      const double gain = total();
      if (gain <= most) continue;
      most = gain;
      best = poses_;
    }
    poses_ = best;
    for (std::size_t sweep = first_sweeps; sweep < std::size(turn_steps); ++sweep) moveAll(turn_steps[sweep]);
    return poses_;
  }

private:
  const UprightAlternative& at(const UprightPair& pair, const ViewTurns& turns) const {
    return pair.at_turn[(turns[pair.a] + pair_turns - turns[pair.b]) % pair_turns];
  }

  /// Along the pairs that say most.
  void place(const ViewTurns& turns) {
    std::size_t first = 0;
    for (std::size_t p = 1; p < pairs_.size(); ++p) {
      if (at(pairs_[p], turns).gain > at(pairs_[first], turns).gain) first = p;
    }
    poses_[pairs_[first].b] = poseOfItsOwn(views_[pairs_[first].b]);
    for (std::size_t step = 0; step < views_.size(); ++step) {  // each adds a view
      const UprightPair* best = nullptr;
      for (const UprightPair& pair : pairs_) {
        if (bool(poses_[pair.a]) == bool(poses_[pair.b])) continue;
        if (best == nullptr || at(pair, turns).gain > at(*best, turns).gain) best = &pair;
      }
      if (best == nullptr) return;
      const Eigen::Isometry3d& T_b_a = at(*best, turns).T_b_a;
      if (poses_[best->b]) {
        poses_[best->a] = *poses_[best->b] * T_b_a;
      } else {
        poses_[best->b] = *poses_[best->a] * T_b_a.inverse();
      }
    }
  }

  void moveAll(double step) {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (poses_[v]) move(v, step);
    }
  }

  double total() const {
    double sum = 0;
    for (const UprightPair& pair : pairs_)
      sum += pair.gainAt(views_, poses_[pair.b]->inverse() * *poses_[pair.a], settings_);
    return sum;
  }

  double gainOf(std::size_t view, const Eigen::Isometry3d& T_model_view) const {
    double sum = 0;
    for (const UprightPair& pair : pairs_) {
      if (pair.a != view && pair.b != view) continue;
      const Eigen::Isometry3d T_model_a = pair.a == view ? T_model_view : *poses_[pair.a];
      const Eigen::Isometry3d T_model_b = pair.b == view ? T_model_view : *poses_[pair.b];
      sum += pair.gainAt(views_, T_model_b.inverse() * T_model_a, settings_);
    }
    return sum;
  }

  void move(std::size_t view, double step) {
    UprightRounds held = moving_rounds;
    held.holds_turn = true;
    const Eigen::Isometry3d before = *poses_[view];
    double best = gainOf(view, before) + least_move_gain;
    const auto consider = [&](const Eigen::Isometry3d& T) {
      const double gain = gainOf(view, T);
      if (gain <= best) return;
      best = gain;
      poses_[view] = T;
    };
    consider(alignedUpright(views_, poses_, view, before, held));
    consider(alignedUpright(views_, poses_, view, before, moving_rounds));
    for (const double turn : {step, -step}) {
      const Eigen::Isometry3d T = *poses_[view];
      const Eigen::Vector3d center = T * views_[view].center;
      const Eigen::Isometry3d turned = Eigen::Translation3d(center) *
                                       Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
                                       Eigen::Translation3d(-center) * T;
      consider(alignedUpright(views_, poses_, view, turned, held));
    }
  }

  const std::vector<CapturedView>& views_;
  const std::vector<UprightPair>& pairs_;
  const VerificationSettings& settings_;
  ViewPoses poses_;
};

}  // namespace

ViewPoses assembledUpright(const std::vector<CapturedView>& views, const std::vector<UprightPair>& pairs,
                           const VerificationSettings& settings) {
  if (pairs.empty()) return ViewPoses(views.size());
  return Assembly(views, pairs, settings).assembled();
}

}  // namespace sks
