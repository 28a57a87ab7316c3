// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_graph.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/registration/body_of_revolution.hpp"
#include "core/registration/turn_ambiguity.hpp"
#include "core/registration/upright_assembly.hpp"
#include "core/registration/view_cluster.hpp"
#include "core/registration/view_evidence.hpp"

namespace sks {
namespace {

constexpr std::size_t most_seeds = 5;                      // loops from which tying is begun; the largest result counts
constexpr double noise_share = 0.015, noise_factor = 2.5;  // of contradictions, see limitsFor()
constexpr int assemblies = 3;                              // of all views, without those that did not fit
constexpr double assembly_slack = 4;                       // of loop limits
constexpr std::size_t fewest_symmetric = 6;                // views from which on an object is known from all around
constexpr int most_moves = 3;                              // of groups of views that fit better elsewhere
constexpr int growths = 2;  // views that drifted poses kept out come in once these are exact

/// What right relations contradict is noise, and about the same for all: the better quarter of the relations shows how
/// much that is. Where there is little of it, less is allowed.
PairLimits limitsFor(const std::vector<ViewRelation>& relations, std::size_t count, PairLimits limits) {
  std::vector<double> shares;
  for (const ViewRelation& relation : relations) {
    if (relation.b < count && relation.determined) shares.push_back(relation.agreement.contradicted());
  }
  if (shares.empty()) return limits;
  const auto quarter = shares.begin() + std::ptrdiff_t(shares.size() / 4);
  std::nth_element(shares.begin(), quarter, shares.end());
  limits.most_contradicted = std::min(limits.most_contradicted, noise_share + noise_factor * *quarter);
  return limits;
}

/// Those among the first views, so many, that contradict no more than is allowed.
std::vector<ViewRelation> allowedRelations(const std::vector<ViewRelation>& found, std::size_t count,
                                           const PairLimits& limits) {
  std::vector<ViewRelation> relations;
  std::copy_if(found.begin(), found.end(), std::back_inserter(relations), [&](const ViewRelation& relation) {
    return relation.b < count && relation.agreement.contradicted() <= limits.most_contradicted;
  });
  return relations;
}

bool allOnPlanes(const std::vector<CapturedView>& views) {
  return std::all_of(views.begin(), views.end(), [](const CapturedView& view) { return bool(view.plane); });
}

/// How views are tied: all that stays the same, whichever of them are there.
struct Rules {
  const Settings& settings;
  const PairLimits& widest;
  const LoopLimits& loops;
  int threads;
};

/// What views say at common poses, as far as they share something there.
std::vector<ViewRelation> relationsAt(const std::vector<CapturedView>& views, const ViewPoses& poses,
                                      const Rules& rules) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < views.size(); ++a) {
    for (std::size_t b = a + 1; b < views.size(); ++b) {
      if (poses[a] && poses[b]) pairs.emplace_back(a, b);
    }
  }
  std::vector<ViewRelation> relations(pairs.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(rules.threads)
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    const Eigen::Isometry3d T_b_a = poses[b]->inverse() * *poses[a];
    const ViewEvidence shared =
        ViewComparison(views[a], views[b], rules.settings.verification).at(T_b_a, UsualPrints());
    if (shared.overlap >= rules.widest.least_overlap) {
      relations[p] = relationAt(views[a], views[b], T_b_a, rules.settings, rules.widest);
    }
    relations[p].a = a;
    relations[p].b = b;
  }
  return relations;
}

/// The largest cluster of some views. Refers to all that it is made of, so it cannot be copied.
class LargestCluster {
public:
  /// @param count only the first views, so many
  LargestCluster(const std::vector<CapturedView>& views, const PairwiseKnowledge& pairs, std::size_t count,
                 const Rules& rules)
      : views_(views), rules_(rules), limits_(rules.widest), reasons_(views.size()) {
    if (pairs.relations.empty()) {
      tieJointly(pairs.upright, count);
    } else {
      tieByLoops(pairs.relations, count);
    }
  }
  LargestCluster(const LargestCluster&) = delete;
  LargestCluster& operator=(const LargestCluster&) = delete;

  const std::vector<CapturedView>& views() const { return views_; }
  const std::vector<ViewRelation>& relations() const { return relations_; }
  /// Of a view that was not tied with all others at once, in words; empty: none was found.
  const std::string& reason(std::size_t view) const { return reasons_[view]; }
  const std::optional<ViewCluster>& tied() const { return tied_; }  ///< none: nothing could be tied
  /// Turns by 360 / order degrees look the same; 1: none does.
  int order() const { return order_; }

private:
  void tieByLoops(const std::vector<ViewRelation>& found, std::size_t count) {
    limits_ = limitsFor(found, count, rules_.widest);
    relations_ = allowedRelations(found, count, limits_);
    table_.emplace(views_, relations_);
    std::vector<ViewCluster> tried;
    for (const ViewLoop& loop : closedLoops(*table_, rules_.loops)) {
      if (tried.size() >= most_seeds) break;
      if (std::any_of(tried.begin(), tried.end(), [&](const ViewCluster& cluster) { return cluster.holds(loop); }))
        continue;
      ViewCluster cluster(*table_, rules_.settings, limits_, rules_.loops, rules_.threads);
      cluster.begin(loop);
      for (int round = 0; round < growths; ++round) {
        cluster.grow();
        cluster.complete();
      }
      tried.push_back(cluster);
    }
    for (const ViewCluster& cluster : tried) {
      const auto key = [](const ViewCluster& c) { return std::make_pair(c.size(), c.weight()); };
      if (cluster.size() > fewest_edges && (!tied_ || key(cluster) > key(*tied_))) tied_.emplace(cluster);
    }
  }

  /// Puts all views together, and once more without those that contradict the others.
  void tieJointly(const std::vector<UprightPair>& pairs, std::size_t count) {
    std::vector<char> left(views_.size(), 0);
    for (std::size_t v = 0; v < count; ++v) left[v] = bool(views_[v].plane);
    for (int round = 0; round < assemblies; ++round) {
      if (std::count(left.begin(), left.end(), 1) <= std::ptrdiff_t(fewest_edges)) return tied_.reset();
      std::vector<UprightPair> among;
      std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(among),
                   [&](const UprightPair& pair) { return left[pair.a] && left[pair.b]; });
      ViewPoses poses = assembledUpright(views_, among, rules_.settings.verification);
      for (const double slack : {assembly_slack, 1.0}) {  // groups of views are some degrees apart at first
        if (slack == 1.0) turnToBest(poses, among);
        relations_ = relationsAt(views_, poses, rules_);
        limits_ = limitsFor(relations_, count, rules_.widest);
        table_.emplace(views_, relations_);
        tied_.emplace(*table_, rules_.settings, limits_, rules_.loops, rules_.threads);
        tied_->adopt(poses, slack);
        poses = tied_->poses();
      }
      const std::vector<std::ptrdiff_t> opponents = tied_->dropContradicted();
      bool dropped = false;
      for (std::size_t v = 0; v < count; ++v) {
        if (!left[v] || tied_->isTied(v)) continue;
        reasons_[v] = opponents[v] < 0 ? "it shows something besides the object that the other views do not"
                                       : "it contradicts what '" + views_[std::size_t(opponents[v])].source + "' saw";
        left[v] = 0;
        dropped = true;
      }
      if (!dropped) break;
    }
    dropAmbiguous(pairs);
    if (tied_->size() <= fewest_edges) tied_.reset();
  }

  /// Turns views and groups of them that fit better so, as long as there are any.
  void turnToBest(ViewPoses& poses, const std::vector<UprightPair>& pairs) const {
    for (int move = 0; move < most_moves; ++move) {
      const TurnAmbiguity found = findOtherTurns(views_, poses, pairs, rules_.settings.verification, rules_.threads);
      const OtherTurn* best = found.best();
      if (best == nullptr) return;
      for (const std::size_t v : best->views) poses[v] = best->motion * *poses[v];
    }
  }

  /// Lets views go whose turns stay open.
  void dropAmbiguous(const std::vector<UprightPair>& pairs) {
    for (std::size_t step = 0; step < views_.size(); ++step) {  // each drops some: what they said of others is gone too
      tied_->dropUnshared();
      const TurnAmbiguity found =
          findOtherTurns(views_, tied_->poses(), pairs, rules_.settings.verification, rules_.threads);
      order_ = found.order;
      bool dropped = false;
      for (const std::optional<OtherTurn>& other : found.others) {
        if (!other || !other->isOther() || other->isRefuted()) continue;
        const auto degrees = std::lround(std::abs(other->angle()) * 180 / EIGEN_PI);
        for (const std::size_t v : other->views) {
          tied_->letGo(v);
          reasons_[v] = "it fits the other views as well when it is turned by " + std::to_string(degrees) + " degrees";
        }
        dropped = true;
      }
      if (!dropped || tied_->size() <= fewest_edges) return;
    }
  }

  const std::vector<CapturedView>& views_;
  const Rules& rules_;
  PairLimits limits_;
  std::vector<std::string> reasons_;
  std::vector<ViewRelation> relations_;
  std::optional<RelationTable> table_;
  std::optional<ViewCluster> tied_;
  int order_ = 1;
};

/// Why a view could not be tied, in words.
std::string reasonOf(std::size_t view, const LargestCluster& best) {
  const std::optional<ViewCluster>& tied = best.tied();
  const std::vector<CapturedView>& views = best.views();
  std::size_t related = 0, determined = 0;
  for (const ViewRelation& relation : best.relations()) {
    if (relation.a != view && relation.b != view) continue;
    ++related;
    determined += relation.determined ? 1 : 0;
  }
  if (views.size() < 2) return "it is the only view";
  if (views.size() == 2) return "two views alone cannot confirm each other: capture more";
  if (!best.reason(view).empty()) return best.reason(view);
  if (related == 0) return "it fits no other view";
  if (determined == 0) {
    return "what it shares with other views looks the same from several sides: its turn cannot be told";
  }
  if (!tied) return "no three views confirm each other";
  if (tied->isForeign(view)) return "it shows something besides the object that the other views do not";
  std::vector<PoseProposal> proposals;
  tied->propose(view, proposals);
  if (proposals.empty()) return "no two views agree on its pose";
  const std::ptrdiff_t against = tied->contradiction(view, proposals.front().T_model_view);
  if (against >= 0) return "it contradicts what '" + views[std::size_t(against)].source + "' saw";
  return "no two views agree on its pose closely enough";
}

/// Views of a body of revolution; none if it is no such body, or if it is not known how it stood.
std::optional<TiedViews> tiedAsRevolved(const std::vector<CapturedView>& views, const Settings& settings,
                                        const PairLimits& limits, int threads) {
  if (!allOnPlanes(views)) return std::nullopt;
  std::vector<Eigen::Isometry3d> upright;
  for (const CapturedView& view : views) upright.push_back(poseOfItsOwn(view));
  const std::optional<ViewPoses> poses = posesOfRevolution(views, upright, settings, limits, threads);
  if (!poses) return std::nullopt;
  TiedViews result;
  result.T_model_view = *poses;
  result.reasons.resize(views.size());
  const ViewPoses none;
  result.axes = orientModel(views, result.T_model_view, [&](std::size_t) -> const ViewPoses& { return none; });
  result.symmetry = Symmetry();
  return result;
}

}  // namespace

TiedViews tieViews(const std::vector<CapturedView>& views, const PairwiseKnowledge& found, const Settings& settings,
                   const PairLimits& limits, const LoopLimits& loops, int threads, EarlierTies& earlier) {
  if (std::optional<TiedViews> revolved = tiedAsRevolved(views, settings, limits, threads)) return *revolved;
  const Rules rules{settings, limits, loops, threads};
  LargestCluster best(views, found, views.size(), rules);
  TiedViews result;
  result.T_model_view.resize(views.size());
  result.reasons.resize(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!best.tied() || !best.tied()->isTied(v)) result.reasons[v] = reasonOf(v, best);
  }
  if (best.tied()) result.T_model_view = best.tied()->poses();
  earlier.resize(views.size() + 1);
  earlier[views.size()] = result.T_model_view;
  if (!best.tied()) return result;
  result.axes = orientModel(views, result.T_model_view, [&](std::size_t count) -> const ViewPoses& {
    if (!earlier[count]) {
      const LargestCluster before(views, found, count, rules);
      earlier[count] = before.tied() ? before.tied()->poses() : ViewPoses(views.size());
    }
    return *earlier[count];
  });
  result.loops = best.tied()->loopErrors();
  if (best.order() > 1 && best.tied()->size() >= fewest_symmetric) {
    result.symmetry = Symmetry{Eigen::Vector3d::UnitZ(), best.order()};
  }
  return result;
}

}  // namespace sks
