// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/turn_assignment.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sks {
namespace {

constexpr std::size_t most_starts = 60;   // pairs from which views are assigned
constexpr std::size_t other_turn = 6;     // steps from which on a turn is another one
constexpr int most_rounds = 20;           // of turning views and groups
constexpr double least_turn_gain = 1e-6;  // of a move

std::size_t difference(std::size_t turn, std::size_t from) {
  return (turn + pair_turns - from) % pair_turns;
}

class Assignment {
public:
  Assignment(std::size_t views, const std::vector<UprightPair>& pairs)
      : count_(views), table_(views * views, nullptr), turn_(views, 0), placed_(views, 0) {
    for (const UprightPair& pair : pairs) {
      table_[pair.a * views + pair.b] = &pair;
      table_[pair.b * views + pair.a] = &pair;
    }
  }

  void start(const UprightPair& pair) {
    std::fill(placed_.begin(), placed_.end(), 0);
    std::size_t best = 0;
    for (std::size_t t = 1; t < pair_turns; ++t) best = pair.at_turn[t].gain > pair.at_turn[best].gain ? t : best;
    turn_[pair.b] = 0;
    turn_[pair.a] = best;
    placed_[pair.a] = placed_[pair.b] = 1;
  }

  /// Adds all other views, the one whose turn is told best first.
  void grow() {
    for (std::size_t step = 2; step < count_; ++step) {
      std::size_t chosen = count_, chosen_turn = 0;
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t v = 0; v < count_; ++v) {
        if (placed_[v]) continue;
        const std::vector<double> gains = gainsOf(v);
        const auto best = std::size_t(std::max_element(gains.begin(), gains.end()) - gains.begin());
        double second = -std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < pair_turns; ++t) {
          const std::size_t apart = difference(t, best);
          if (std::min(apart, pair_turns - apart) >= other_turn) second = std::max(second, gains[t]);
        }
        if (gains[best] - second <= most) continue;
        most = gains[best] - second;
        chosen = v;
        chosen_turn = best;
      }
      turn_[chosen] = chosen_turn;
      placed_[chosen] = 1;
    }
  }

  void improve() {
    for (int round = 0; round < most_rounds; ++round) {
      const bool turned = turnViews(), grouped = turnGroups();
      if (!turned && !grouped) return;
    }
  }

  double total() const {
    double sum = 0;
    for (std::size_t v = 0; v < count_; ++v) {
      for (std::size_t w = v + 1; w < count_; ++w) sum += gain(v, turn_[v], w, turn_[w]);
    }
    return sum;
  }
  const std::vector<std::size_t>& turns() const { return turn_; }

private:
  double gain(std::size_t v, std::size_t turn_v, std::size_t w, std::size_t turn_w) const {
    const UprightPair* pair = table_[v * count_ + w];
    if (pair == nullptr) return 0;
    return pair->at_turn[pair->a == v ? difference(turn_v, turn_w) : difference(turn_w, turn_v)].gain;
  }

  std::vector<double> gainsOf(std::size_t v) const {
    std::vector<double> gains(pair_turns, 0);
    for (std::size_t t = 0; t < pair_turns; ++t) {
      for (std::size_t w = 0; w < count_; ++w) {
        if (w != v && placed_[w]) gains[t] += gain(v, t, w, turn_[w]);
      }
    }
    return gains;
  }

  bool turnViews() {
    bool improved = false;
    for (std::size_t v = 0; v < count_; ++v) {
      const std::vector<double> gains = gainsOf(v);
      const auto best = std::size_t(std::max_element(gains.begin(), gains.end()) - gains.begin());
      if (gains[best] <= gains[turn_[v]] + least_turn_gain) continue;
      turn_[v] = best;
      improved = true;
    }
    return improved;
  }

  /// Groups grow from each view by those that follow it best.
  bool turnGroups() {
    bool improved = false;
    for (std::size_t first = 0; first < count_; ++first) {
      for (std::size_t by = 1; by < pair_turns; ++by) improved = turnGroup(first, by) || improved;
    }
    return improved;
  }

  bool turnGroup(std::size_t first, std::size_t by) {
    std::vector<char> group(count_, 0), best_group;
    // of each view: what is gained if it follows the group
    std::vector<double> changes(count_, 0);
    for (std::size_t v = 0; v < count_; ++v) {
      for (std::size_t w = 0; w < count_; ++w) {
        if (w != v) changes[v] += gain(v, turned(v, by), w, turn_[w]) - gain(v, turn_[v], w, turn_[w]);
      }
    }
    double sum = 0, best = least_turn_gain;
    std::size_t next = first;
    for (std::size_t size = 1; size < count_; ++size) {
      sum += changes[next];
      group[next] = 1;
      if (sum > best) {
        best = sum;
        best_group = group;
      }
      const std::size_t added = next;
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t v = 0; v < count_; ++v) {
        if (group[v]) continue;
        changes[v] += gain(v, turned(v, by), added, turned(added, by)) - gain(v, turn_[v], added, turned(added, by)) -
                      gain(v, turned(v, by), added, turn_[added]) + gain(v, turn_[v], added, turn_[added]);
        if (changes[v] <= most) continue;
        most = changes[v];
        next = v;
      }
    }
    if (best_group.empty()) return false;
    for (std::size_t v = 0; v < count_; ++v) {
      if (best_group[v]) turn_[v] = turned(v, by);
    }
    return true;
  }

  std::size_t turned(std::size_t v, std::size_t by) const { return (turn_[v] + by) % pair_turns; }

  std::size_t count_;
  std::vector<const UprightPair*> table_;
  std::vector<std::size_t> turn_;
  std::vector<char> placed_;
};

/// Whether no pair would be turned otherwise.
bool areNearlySame(const ViewTurns& x, const ViewTurns& y, const std::vector<UprightPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [&](const UprightPair& pair) {
    const std::size_t apart = difference(difference(x[pair.a], x[pair.b]), difference(y[pair.a], y[pair.b]));
    return std::min(apart, pair_turns - apart) < other_turn;
  });
}

}  // namespace

std::vector<ViewTurns> assignedTurns(std::size_t views, const std::vector<UprightPair>& pairs, std::size_t most) {
  Assignment assignment(views, pairs);
  std::vector<std::size_t> order(pairs.size());
  std::vector<double> gains;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    order[p] = p;
    double best = 0;
    for (const UprightAlternative& alternative : pairs[p].at_turn) best = std::max(best, alternative.gain);
    gains.push_back(best);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return gains[p] > gains[q]; });
  order.resize(std::min(order.size(), most_starts));
  std::vector<std::pair<double, ViewTurns>> found;
  for (const std::size_t p : order) {
    assignment.start(pairs[p]);
    assignment.grow();
    assignment.improve();
    found.emplace_back(assignment.total(), assignment.turns());
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<ViewTurns> best;
  for (auto& [total, turns] : found) {
    if (best.size() >= most) break;
    if (std::none_of(best.begin(), best.end(), [&, &candidate = turns](const ViewTurns& other) {
          return areNearlySame(candidate, other, pairs);
        }))
      best.push_back(std::move(turns));
  }
  if (best.empty()) best.emplace_back(views, 0);
  return best;
}

}  // namespace sks
