// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/upright_pair.hpp"

#include <algorithm>
#include <cmath>

#include "core/registration/upright_alignment.hpp"

namespace sks {
namespace {

constexpr double contradiction_loss =
    4;                                  // of a patch: log of how much rarer they are in right poses than in wrong ones
constexpr double overlap_worth = 0.02;  // of a patch: where nothing else tells, views share what they can
constexpr double telling_overlap = 0.15;
constexpr std::size_t aligned_points = 100;
constexpr int outline_rounds = 6;
constexpr std::size_t free_step = 2;             // turns from one to the next from which alignment finds the turn, too
constexpr double least_gain = -60;               // what contradicts more is as wrong
constexpr double known_turn_deviation = 0.0175;  // [rad] 1 degree: of odometry and of the camera's place on the robot
// What was captured from one place may have been turned by hand in between [rad], 5 degrees; [m].
constexpr double least_known_turn = 0.087, least_known_shift = 0.03;
constexpr double turn_step = 2 * double(EIGEN_PI) / double(pair_turns);

/// The cell of a turn.
std::size_t turnAt(double angle) {
  const auto steps = std::lround(angle / turn_step) % long(pair_turns);
  return std::size_t(steps < 0 ? steps + long(pair_turns) : steps);
}

/// Turn of a against b by how the camera was moved in between; none: it is not known, or it was not moved.
std::optional<double> knownTurn(const CapturedView& a, const CapturedView& b) {
  if (!a.T_fixed_view || !b.T_fixed_view) return std::nullopt;
  const Eigen::Isometry3d T_b_a = b.T_fixed_view->inverse() * *a.T_fixed_view;
  if (Eigen::AngleAxisd(T_b_a.linear()).angle() < least_known_turn && T_b_a.translation().norm() < least_known_shift)
    return std::nullopt;
  return turnOf(poseOfItsOwn(b) * T_b_a * poseOfItsOwn(a).inverse());
}

}  // namespace

double UprightPair::motionGain(double turn) const {
  if (!known_turn) return 0;
  const double apart = std::remainder(turn - *known_turn, 2 * double(EIGEN_PI)) / known_turn_deviation;
  return std::max(least_gain, -0.5 * apart * apart);
}

double UprightPair::gainOf(const ViewEvidence& e) const {
  const double color = known_turn ? 0 : e.color;  // light looks like print: it is only asked where nothing else tells
  return e.shape + (overlap_worth - best_shape) * e.matched + color - contradiction_loss * e.against;
}

double UprightPair::bestGainNear(double turn) const {
  const std::size_t middle = turnAt(turn);
  double best = least_gain;
  for (const std::size_t step : {pair_turns - 1, std::size_t(0), std::size_t(1)})
    best = std::max(best, at_turn[(middle + step) % pair_turns].gain);
  return best;
}

UprightPair::Gain UprightPair::gainsAt(const std::vector<CapturedView>& views, const Eigen::Isometry3d& T_b_a,
                                       const VerificationSettings& settings) const {
  const ViewEvidence evidence = ViewComparison(views[a], views[b], settings).at(T_b_a, usual);
  const double turn = turnOf(poseOfItsOwn(views[b]) * T_b_a * poseOfItsOwn(views[a]).inverse());
  const double pictures = gainOf(evidence), all = pictures + motionGain(turn);
  return {all, known_turn ? all : all - evidence.color, pictures};
}

double UprightPair::gainAt(const std::vector<CapturedView>& views, const Eigen::Isometry3d& T_b_a,
                           const VerificationSettings& settings) const {
  return gainsAt(views, T_b_a, settings).all;
}

Eigen::Isometry3d poseOfItsOwn(const CapturedView& view) {
  if (!view.plane) return Eigen::Isometry3d::Identity();
  const Eigen::Vector3d up = view.plane->normal(), foot = view.plane->projection(view.center);
  const Eigen::Vector3d to_camera = view.surface.sensor_origin.cast<double>() - foot;
  Eigen::Vector3d x = to_camera - up.dot(to_camera) * up;
  if (x.norm() < 1e-6) x = up.unitOrthogonal();
  x.normalize();
  Eigen::Isometry3d T_view_model = Eigen::Isometry3d::Identity();
  T_view_model.linear() << x, up.cross(x), up;
  T_view_model.translation() = foot;
  return T_view_model.inverse();
}

double turnOf(const Eigen::Isometry3d& motion) {
  return std::atan2(motion.linear()(1, 0), motion.linear()(0, 0));
}

UprightPair compareUpright(const std::vector<CapturedView>& views, std::size_t a, std::size_t b,
                           const VerificationSettings& settings) {
  UprightPair pair;
  pair.a = a;
  pair.b = b;
  pair.known_turn = knownTurn(views[a], views[b]);
  const Eigen::Isometry3d own_a = poseOfItsOwn(views[a]), own_b = poseOfItsOwn(views[b]);
  ViewPoses poses(views.size());
  poses[b] = own_b;
  UprightRounds free, held;
  free.points = held.points = aligned_points;
  held.holds_turn = true;
  held.outlines = outline_rounds;
  const ViewComparison comparison(views[a], views[b], settings);
  struct Tried {
    std::size_t turn;
    Eigen::Isometry3d T_b_a;
  };
  std::vector<Tried> tried;
  for (std::size_t turn = 0; turn < pair_turns; ++turn) {
    const Eigen::Isometry3d start(Eigen::AngleAxisd(double(turn) * turn_step, Eigen::Vector3d::UnitZ()));
    const Eigen::Isometry3d at_turn = alignedUpright(views, poses, a, start * own_a, held);
    tried.push_back({turn, own_b.inverse() * at_turn});
    comparison.learn(tried.back().T_b_a, pair.usual);
    if (turn % free_step != 0) continue;
    const Eigen::Isometry3d T = alignedUpright(views, poses, a, at_turn, free);
    tried.push_back({turnAt(turnOf(T * own_a.inverse())), own_b.inverse() * T});
  }
  std::vector<ViewEvidence> evidence;
  for (const Tried& t : tried) {
    evidence.push_back(comparison.at(t.T_b_a, pair.usual));
    const ViewEvidence& e = evidence.back();
    if (e.overlap >= telling_overlap) pair.best_shape = std::max(pair.best_shape, e.shape / e.matched);
  }
  std::array<char, pair_turns> filled{};
  for (UprightAlternative& alternative : pair.at_turn) alternative.gain = least_gain;
  for (std::size_t k = 0; k < tried.size(); ++k) {
    const std::size_t turn = tried[k].turn;
    const double motion_gain = pair.motionGain(turnOf(own_b * tried[k].T_b_a * own_a.inverse()));
    const double gain = std::max(least_gain, pair.gainOf(evidence[k]) + motion_gain);
    if (filled[turn] && gain <= pair.at_turn[turn].gain) continue;
    pair.at_turn[turn] = {tried[k].T_b_a, gain, evidence[k].overlap};
    filled[turn] = 1;
  }
  return pair;
}

}  // namespace sks
