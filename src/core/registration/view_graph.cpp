// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_graph.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/registration/view_cluster.hpp"

namespace sks {
namespace {

constexpr std::size_t most_seeds = 5;                      // loops from which tying is begun; the largest result counts
constexpr double noise_share = 0.015, noise_factor = 2.5;  // of contradictions, see limitsFor()
constexpr int growths = 2;  // views that drifted poses kept out come in once these are exact

/// What right relations contradict is noise, and about the same for all: the better quarter of the relations shows how
/// much that is. Where there is little of it, less is allowed.
PairLimits limitsFor(const std::vector<ViewRelation>& relations, PairLimits limits) {
  std::vector<double> shares;
  for (const ViewRelation& relation : relations) {
    if (relation.determined) shares.push_back(relation.agreement.contradicted());
  }
  if (shares.empty()) return limits;
  const auto quarter = shares.begin() + std::ptrdiff_t(shares.size() / 4);
  std::nth_element(shares.begin(), quarter, shares.end());
  limits.most_contradicted = std::min(limits.most_contradicted, noise_share + noise_factor * *quarter);
  return limits;
}

/// Why a view could not be tied, in words.
std::string reasonOf(std::size_t view, const std::optional<ViewCluster>& tied, const RelationTable& table,
                     const std::vector<ViewRelation>& relations) {
  std::size_t related = 0, determined = 0;
  for (const ViewRelation& relation : relations) {
    if (relation.a != view && relation.b != view) continue;
    ++related;
    determined += relation.determined ? 1 : 0;
  }
  if (table.views().size() < 2) return "it is the only view";
  if (table.views().size() == 2) return "two views alone cannot confirm each other: capture more";
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
  if (against >= 0) return "it contradicts what '" + table.views()[std::size_t(against)].source + "' saw";
  return "no two views agree on its pose closely enough";
}

}  // namespace

TiedViews tieViews(const std::vector<CapturedView>& views, const std::vector<ViewRelation>& found,
                   const Settings& settings, const PairLimits& widest, const LoopLimits& loop_limits, int threads) {
  const PairLimits limits = limitsFor(found, widest);
  std::vector<ViewRelation> relations;
  std::copy_if(found.begin(), found.end(), std::back_inserter(relations), [&](const ViewRelation& relation) {
    return relation.agreement.contradicted() <= limits.most_contradicted;
  });
  const RelationTable table(views, relations);
  const std::vector<ViewLoop> loops = closedLoops(table, loop_limits);
  std::optional<ViewCluster> best;
  std::vector<ViewCluster> tried;
  for (const ViewLoop& loop : loops) {
    if (tried.size() >= most_seeds) break;
    if (std::any_of(tried.begin(), tried.end(), [&](const ViewCluster& cluster) { return cluster.holds(loop); }))
      continue;
    ViewCluster cluster(table, settings, limits, loop_limits, threads);
    cluster.begin(loop);
    for (int round = 0; round < growths; ++round) {
      cluster.grow();
      cluster.complete();
    }
    cluster.orient();
    tried.push_back(cluster);
  }
  for (const ViewCluster& cluster : tried) {
    const auto key = [](const ViewCluster& c) { return std::make_pair(c.size(), c.weight()); };
    if (cluster.size() > fewest_edges && (!best || key(cluster) > key(*best))) best.emplace(cluster);
  }
  TiedViews result;
  result.T_model_view.resize(views.size());
  result.reasons.resize(views.size());
  if (best) {
    result.T_model_view = best->poses();
    result.first = best->first();
    result.loops = best->loopErrors();
  }
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!result.T_model_view[v]) result.reasons[v] = reasonOf(v, best, table, relations);
  }
  return result;
}

}  // namespace sks
