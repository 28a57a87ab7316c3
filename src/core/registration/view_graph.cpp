// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/registration/pose_graph.hpp"

namespace sks {
namespace {

constexpr std::size_t most_seeds = 5;    // loops from which tying is begun; the largest result counts
constexpr std::size_t fewest_edges = 2;  // of a tied view: what a single pair says is not believed
constexpr int completions = 2;           // rounds in which pairs are aligned anew from the common poses
constexpr double majority = 2;           // weight of the relations that agree on a pose over that of others
constexpr int fewest_refuting = 2;       // views that saw nothing there: one may have lost a part of the object
constexpr double most_foreign = 0.06;    // of a view's points
constexpr double noise_share = 0.015, noise_factor = 2.5;  // of contradictions, see limitsFor()
constexpr int growths = 2;     // views that drifted poses kept out come in once these are exact
constexpr double slack = 1.5;  // of the limits of contradictions, for poses that are not optimised yet
constexpr std::size_t compared_points = 800;

double angleBetween(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other) {
  return Eigen::AngleAxisd(T.linear().transpose() * other.linear()).angle();
}

/// The relations of each pair of views.
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

bool near(const Eigen::Isometry3d& T, const Eigen::Isometry3d& other, const Eigen::Vector3d& center,
          const LoopLimits& limits) {
  return (T * center - other * center).norm() <= limits.shift && angleBetween(T, other) <= limits.angle;
}

/// Three relations that close a loop.
struct Loop {
  std::size_t i, j, k;     // views
  std::size_t ij, jk, ik;  // relations
  double weight;
};

std::vector<Loop> closedLoops(const RelationTable& table, const LoopLimits& limits) {
  std::vector<Loop> loops;
  const std::size_t n = table.views().size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (const std::size_t ij : table.of(i, j)) {
        for (std::size_t k = j + 1; k < n; ++k) {
          for (const std::size_t jk : table.of(j, k)) {
            for (const std::size_t ik : table.of(i, k)) {
              const Eigen::Isometry3d around = table.pose(jk, j) * table.pose(ij, i);
              if (!near(around, table.pose(ik, i), table.views()[i].center, limits)) continue;
              loops.push_back({i, j, k, ij, jk, ik, table.at(ij).score + table.at(jk).score + table.at(ik).score});
            }
          }
        }
      }
    }
  }
  std::stable_sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.weight > b.weight; });
  return loops;
}

/// A pose of a view that is not tied yet, by relations to tied ones.
struct Proposal {
  std::size_t view = 0;
  Eigen::Isometry3d T_model_view = Eigen::Isometry3d::Identity();
  double weight = 0;      // of the relations that agree
  std::size_t edges = 0;  // how many
};

/// What was tied from one loop.
class Cluster {
public:
  Cluster(const RelationTable& table, const Settings& settings, const PairLimits& limits, const LoopLimits& loops,
          int threads)
      : table_(table),
        settings_(settings),
        limits_(limits),
        loops_(loops),
        threads_(threads),
        poses_(table.views().size()),
        foreign_(table.views().size(), 0) {}

  void begin(const Loop& loop) {
    first_ = std::min({loop.i, loop.j, loop.k});
    poses_[loop.i] = Eigen::Isometry3d::Identity();
    poses_[loop.j] = table_.pose(loop.ij, loop.i).inverse();
    poses_[loop.k] = table_.pose(loop.ik, loop.i).inverse();
    toFrameOf(first_);
    optimize();
  }

  void grow() {
    for (std::size_t step = 0; step < poses_.size(); ++step) {  // each adds a view
      std::vector<Proposal> proposals;
      for (std::size_t view = 0; view < poses_.size(); ++view) {
        if (!poses_[view] && !foreign_[view]) propose(view, proposals);
      }
      std::stable_sort(proposals.begin(), proposals.end(), [](const Proposal& a, const Proposal& b) {
        return std::make_pair(a.edges >= fewest_edges, a.weight) > std::make_pair(b.edges >= fewest_edges, b.weight);
      });
      const auto allowed =
          std::find_if(proposals.begin(), proposals.end(), [&](const Proposal& p) { return isAllowed(p); });
      if (allowed == proposals.end()) return;
      poses_[allowed->view] = allowed->T_model_view;
      optimize();
    }
  }

  /// Whether no tied view contradicts it, and enough of them confirm it: those that proposed it, or else those that
  /// alignment from the proposed pose brings back to it.
  bool isAllowed(const Proposal& p) const {
    if (contradiction(p.view, p.T_model_view) >= 0) return false;
    return p.edges >= fewest_edges || confirmations(p) >= fewest_edges;
  }

  /// Aligns all pairs anew from the common poses, drops what does not fit, and optimises again.
  void complete() {
    for (int round = 0; round < completions; ++round) {
      realign();
      dropOpenLoops();
      solve(edges_);
      dropLoose();
      dropForeign();
      dropLoose();
    }
  }

  /// Turns the model as its frame is defined by the first tied view, which may have come in late.
  void orient() {
    if (size() == 0) return;
    first_ = firstTied();
    const CapturedView& view = table_.views()[first_];
    const Eigen::Isometry3d T_old_view = *poses_[first_];
    Eigen::Isometry3d T_new_old = T_old_view.inverse();
    if (view.plane) {  // z stays
      const Eigen::Vector3d from = T_old_view * view.surface.sensor_origin.cast<double>() - T_old_view * view.center;
      T_new_old = Eigen::Isometry3d(Eigen::AngleAxisd(-std::atan2(from.y(), from.x()), Eigen::Vector3d::UnitZ()));
    }
    for (auto& pose : poses_) {
      if (pose) pose = T_new_old * *pose;
    }
  }

  std::size_t size() const {
    return std::size_t(std::count_if(poses_.begin(), poses_.end(), [](const auto& pose) { return bool(pose); }));
  }
  double weight() const { return weight_; }
  std::size_t first() const { return first_; }
  const std::vector<std::optional<Eigen::Isometry3d>>& poses() const { return poses_; }
  bool isForeign(std::size_t view) const { return foreign_[view] != 0; }
  bool holds(const Loop& loop) const { return poses_[loop.i] && poses_[loop.j] && poses_[loop.k]; }

  LoopErrors loopErrors() const;

  /// The tied view that contradicts a pose most, in shape or colour, if by more than the limits allow; else -1.
  std::ptrdiff_t contradiction(std::size_t view, const Eigen::Isometry3d& T_model_view) const {
    double worst = slack;
    std::ptrdiff_t worst_view = -1;
    const std::vector<CapturedView>& views = table_.views();
    for (std::size_t t = 0; t < poses_.size(); ++t) {
      if (!poses_[t] || t == view) continue;
      const std::size_t stride = std::max<std::size_t>(1, views[view].points.size() / compared_points);
      const ViewAgreement agreement =
          compareViews(views[view], views[t], poses_[t]->inverse() * T_model_view, settings_.verification, stride);
      const double discolored = agreement.overlap() >= limits_.least_overlap ? 1 - agreement.color : 0;
      const double against =
          std::max(agreement.contradicted() / limits_.most_contradicted, discolored / (1 - limits_.least_color));
      if (against <= worst) continue;
      worst = against;
      worst_view = std::ptrdiff_t(t);
    }
    return worst_view;
  }

  /// The best poses of a view by its relations to tied views, whether they are allowed or not.
  void propose(std::size_t view, std::vector<Proposal>& proposals) const;

private:
  std::size_t confirmations(const Proposal& p) const;
  void toFrameOf(std::size_t view) {
    const Eigen::Isometry3d T_model_old = initialPose(view) * poses_[view]->inverse();
    for (auto& pose : poses_) {
      if (pose) pose = T_model_old * *pose;
    }
  }
  Eigen::Isometry3d initialPose(std::size_t view) const;
  std::size_t firstTied() const {
    return std::size_t(std::find_if(poses_.begin(), poses_.end(), [](const auto& p) { return bool(p); }) -
                       poses_.begin());
  }
  std::vector<PoseEdge> agreeingEdges() const;
  void optimize() { solve(agreeingEdges()); }
  void solve(const std::vector<PoseEdge>& edges);
  /// Three edges of three views, and by how much they do not close.
  struct EdgeLoop {
    std::array<std::size_t, 3> edges;
    double shift, angle;
  };
  std::vector<EdgeLoop> edgeLoops() const;
  void realign();
  void dropOpenLoops();
  void dropLoose();
  void dropForeign();
  double foreignShare(std::size_t view) const;

  const RelationTable& table_;
  const Settings& settings_;
  const PairLimits& limits_;
  const LoopLimits& loops_;
  int threads_;
  std::vector<std::optional<Eigen::Isometry3d>> poses_;
  std::vector<PoseEdge> edges_;  // after complete()
  std::vector<double> scores_;   // of the edges
  std::vector<char> foreign_;    // of each view: dropped for what it shows besides
  double weight_ = 0;
  std::size_t first_ = 0;
};

Eigen::Isometry3d Cluster::initialPose(std::size_t view) const {
  const CapturedView& first = table_.views()[view];
  if (!first.plane) return Eigen::Isometry3d::Identity();
  const Eigen::Vector3d up = first.plane->normal(), foot = first.plane->projection(first.center);
  const Eigen::Vector3d to_camera = first.surface.sensor_origin.cast<double>() - foot;
  Eigen::Vector3d x = to_camera - up.dot(to_camera) * up;
  if (x.norm() < 1e-6) x = up.unitOrthogonal();
  x.normalize();
  Eigen::Isometry3d T_view_model = Eigen::Isometry3d::Identity();
  T_view_model.linear() << x, up.cross(x), up;
  T_view_model.translation() = foot;
  return T_view_model.inverse();
}

void Cluster::propose(std::size_t view, std::vector<Proposal>& proposals) const {
  const Eigen::Vector3d& center = table_.views()[view].center;
  struct Linked {
    std::size_t tied;
    Eigen::Isometry3d T_model_view;
    double score;
  };
  std::vector<Linked> links;
  for (const std::size_t r : table_.of(view)) {
    const std::size_t tied = table_.other(r, view);
    if (poses_[tied]) links.push_back({tied, *poses_[tied] * table_.pose(r, view), table_.at(r).score});
  }
  std::map<std::size_t, double> best_of_all;  // of each tied view: whatever it says
  for (const Linked& link : links) best_of_all[link.tied] = std::max(best_of_all[link.tied], link.score);
  Proposal best;
  for (const Linked& seed : links) {
    std::map<std::size_t, const Linked*> agreeing;
    for (const Linked& link : links) {
      if (!near(link.T_model_view, seed.T_model_view, center, loops_)) continue;
      const Linked*& known = agreeing[link.tied];
      if (known == nullptr || link.score > known->score) known = &link;
    }
    double weight = 0, against = 0;
    for (const auto& [tied, score] : best_of_all) {
      const auto found = agreeing.find(tied);
      (found != agreeing.end() ? weight : against) += found != agreeing.end() ? found->second->score : score;
    }
    if (weight < majority * against) continue;
    if (weight > best.weight) best = {view, seed.T_model_view, weight, agreeing.size()};
  }
  if (best.weight > 0) proposals.push_back(best);
}

std::size_t Cluster::confirmations(const Proposal& p) const {
  const std::vector<CapturedView>& views = table_.views();
  std::vector<char> confirms(poses_.size(), 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
  for (std::size_t t = 0; t < poses_.size(); ++t) {
    if (!poses_[t]) continue;
    const Eigen::Isometry3d T_t_view = poses_[t]->inverse() * p.T_model_view;
    const ViewRelation relation = relationAt(views[p.view], views[t], T_t_view, settings_, limits_);
    confirms[t] =
        relation.score > 0 && relation.determined && near(T_t_view, relation.T_b_a, views[p.view].center, loops_);
  }
  return std::size_t(std::count(confirms.begin(), confirms.end(), 1));
}

std::vector<PoseEdge> Cluster::agreeingEdges() const {
  std::vector<PoseEdge> edges;
  for (std::size_t a = 0; a < poses_.size(); ++a) {
    for (std::size_t b = a + 1; b < poses_.size(); ++b) {
      if (!poses_[a] || !poses_[b]) continue;
      const Eigen::Isometry3d T_b_a = poses_[b]->inverse() * *poses_[a];
      for (const std::size_t r : table_.of(a, b)) {
        const ViewRelation& relation = table_.at(r);
        const LoopLimits wide{2 * loops_.angle, 2 * loops_.shift};  // what drifted may still come together
        if (!near(T_b_a, relation.T_b_a, table_.views()[a].center, wide)) continue;
        edges.push_back({a, b, relation.T_b_a, relation.information});
        break;
      }
    }
  }
  return edges;
}

void Cluster::solve(const std::vector<PoseEdge>& edges) {
  if (size() == 0) return;
  std::vector<PoseNode> nodes;
  std::vector<std::size_t> node_of(poses_.size(), 0), view_of;
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    if (!poses_[v]) continue;
    node_of[v] = nodes.size();
    view_of.push_back(v);
    nodes.push_back({*poses_[v], table_.views()[v].center, table_.views()[v].plane});
  }
  std::vector<PoseEdge> among_nodes = edges;
  for (PoseEdge& edge : among_nodes) {
    edge.a = node_of[edge.a];
    edge.b = node_of[edge.b];
  }
  const std::vector<Eigen::Isometry3d> solved = optimizedPoses(nodes, among_nodes, node_of[firstTied()]);
  for (std::size_t k = 0; k < solved.size(); ++k) poses_[view_of[k]] = solved[k];
}

void Cluster::realign() {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < poses_.size(); ++a) {
    for (std::size_t b = a + 1; b < poses_.size(); ++b) {
      if (poses_[a] && poses_[b]) pairs.emplace_back(a, b);
    }
  }
  std::vector<ViewRelation> relations(pairs.size());
  const std::vector<CapturedView>& views = table_.views();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    relations[p] = relationAt(views[a], views[b], poses_[b]->inverse() * *poses_[a], settings_, limits_);
  }
  edges_.clear();
  scores_.clear();
  weight_ = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    const ViewRelation& relation = relations[p];
    if (!(relation.score > 0) || !relation.determined) continue;
    if (!near(poses_[b]->inverse() * *poses_[a], relation.T_b_a, views[a].center, loops_)) continue;
    edges_.push_back({a, b, relation.T_b_a, relation.information});
    scores_.push_back(relation.score);
    weight_ += relation.score;
  }
}

/// Edges that do not fit the common poses, and views that too few edges hold.
void Cluster::dropLoose() {
  const auto fits = [&](const PoseEdge& edge) {
    return poses_[edge.a] && poses_[edge.b] &&
           near(poses_[edge.b]->inverse() * *poses_[edge.a], edge.T_b_a, table_.views()[edge.a].center, loops_);
  };
  for (std::size_t step = 0; step < poses_.size(); ++step) {  // each drops a view
    for (std::size_t e = edges_.size(); e-- > 0;) {
      if (fits(edges_[e])) continue;
      edges_.erase(edges_.begin() + std::ptrdiff_t(e));
      scores_.erase(scores_.begin() + std::ptrdiff_t(e));
    }
    std::vector<std::size_t> count(poses_.size(), 0);
    for (const PoseEdge& edge : edges_) {
      ++count[edge.a];
      ++count[edge.b];
    }
    bool dropped = false;
    for (std::size_t v = 0; v < poses_.size(); ++v) {
      if (!poses_[v] || count[v] >= fewest_edges) continue;
      poses_[v].reset();
      dropped = true;
    }
    if (!dropped) return;
  }
}

/// Share of what a view shows that several others contradict and none confirms: a hand, or a thing that stood beside.
double Cluster::foreignShare(std::size_t view) const {
  const CapturedView& own = table_.views()[view];
  const VerificationSettings& settings = settings_.verification;
  const std::size_t stride = std::max<std::size_t>(1, own.points.size() / compared_points);
  std::size_t points = 0, foreign = 0;
  for (std::size_t i = 0; i < own.points.size(); i += stride) {
    int against = 0, confirmed = 0;
    for (std::size_t t = 0; t < poses_.size(); ++t) {
      if (!poses_[t] || t == view) continue;
      const CapturedView& other = table_.views()[t];
      const Eigen::Isometry3f T = (poses_[t]->inverse() * *poses_[view]).cast<float>();
      const Eigen::Vector3f p = T * own.points.point(i);
      const Sighting seen = other.image.look(p, float(settings.support_distance));
      const bool beside =
          seen.sight == Sight::unknown && other.silhouette.isOutside(p, float(settings.support_distance));
      against += seen.sight == Sight::in_front || beside ? 1 : 0;
      confirmed += seen.sight == Sight::at ? 1 : 0;
    }
    ++points;
    foreign += against >= fewest_refuting && confirmed == 0 ? 1 : 0;
  }
  return points > 0 ? double(foreign) / double(points) : 0;
}

void Cluster::dropForeign() {
  for (std::size_t v = 0; v < poses_.size(); ++v) {
    if (!poses_[v] || foreignShare(v) <= most_foreign) continue;
    poses_[v].reset();
    foreign_[v] = 1;
  }
}

std::vector<Cluster::EdgeLoop> Cluster::edgeLoops() const {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edge_of;
  for (std::size_t e = 0; e < edges_.size(); ++e) edge_of[{edges_[e].a, edges_[e].b}] = e;
  std::vector<EdgeLoop> loops;
  for (const auto& [ij, first] : edge_of) {
    for (auto jk = edge_of.lower_bound({ij.second, 0}); jk != edge_of.end() && jk->first.first == ij.second; ++jk) {
      const auto ik = edge_of.find({ij.first, jk->first.second});
      if (ik == edge_of.end()) continue;
      const Eigen::Isometry3d around = edges_[jk->second].T_b_a * edges_[first].T_b_a;
      const Eigen::Isometry3d& direct = edges_[ik->second].T_b_a;
      const Eigen::Vector3d& center = table_.views()[ij.first].center;
      loops.push_back(
          {{first, jk->second, ik->second}, (around * center - direct * center).norm(), angleBetween(around, direct)});
    }
  }
  return loops;
}

/// Of the edges of loops that do not close the weakest ones.
void Cluster::dropOpenLoops() {
  for (std::size_t step = edges_.size(); step > 0; --step) {  // each drops an edge
    std::optional<std::size_t> weakest;
    for (const EdgeLoop& loop : edgeLoops()) {
      if (loop.shift <= loops_.shift && loop.angle <= loops_.angle) continue;
      for (const std::size_t e : loop.edges) {
        if (!weakest || scores_[e] < scores_[*weakest]) weakest = e;
      }
    }
    if (!weakest) return;
    edges_.erase(edges_.begin() + std::ptrdiff_t(*weakest));
    scores_.erase(scores_.begin() + std::ptrdiff_t(*weakest));
  }
}

LoopErrors Cluster::loopErrors() const {
  std::vector<double> shifts, angles;
  for (const EdgeLoop& loop : edgeLoops()) {
    shifts.push_back(loop.shift);
    angles.push_back(loop.angle);
  }
  LoopErrors errors;
  errors.loops = shifts.size();
  if (shifts.empty()) return errors;
  std::sort(shifts.begin(), shifts.end());
  std::sort(angles.begin(), angles.end());
  errors.median_shift = shifts[shifts.size() / 2];
  errors.median_angle = angles[angles.size() / 2];
  errors.largest_shift = shifts.back();
  errors.largest_angle = angles.back();
  return errors;
}

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
std::string reasonOf(std::size_t view, const std::optional<Cluster>& tied, const RelationTable& table,
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
  std::vector<Proposal> proposals;
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
  const std::vector<Loop> loops = closedLoops(table, loop_limits);
  std::optional<Cluster> best;
  std::vector<Cluster> tried;
  for (const Loop& loop : loops) {
    if (tried.size() >= most_seeds) break;
    if (std::any_of(tried.begin(), tried.end(), [&](const Cluster& cluster) { return cluster.holds(loop); })) continue;
    Cluster cluster(table, settings, limits, loop_limits, threads);
    cluster.begin(loop);
    for (int round = 0; round < growths; ++round) {
      cluster.grow();
      cluster.complete();
    }
    cluster.orient();
    tried.push_back(cluster);
  }
  for (const Cluster& cluster : tried) {
    const auto key = [](const Cluster& c) { return std::make_pair(c.size(), c.weight()); };
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
