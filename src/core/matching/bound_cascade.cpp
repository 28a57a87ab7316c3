// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/bound_cascade.hpp"

#include <algorithm>
#include <limits>
#include <random>

namespace sks {
namespace {

constexpr std::size_t sample_pairs = 6 * row_multiple;

/// Greedy agglomeration of bins, on sampled pairs of words.
class Agglomeration {
public:
  explicit Agglomeration(const SearchedWords& words);

  std::size_t groups() const { return alive_.size(); }
  void mergeCheapest();
  BinMerge merge() const;

private:
  /// One group of bins: what each sampled pair has in it, and what that adds to the pair's distance.
  struct Group {
    std::vector<float> a, b, term;
  };

  /// What the sampled pairs lose of their distance if two groups become one.
  float cost(std::size_t i, std::size_t j) const;
  void findNearestGroup(std::size_t i);

  std::vector<Group> groups_;
  std::vector<std::size_t> alive_;    // groups that stand for themselves, ascending
  std::vector<std::size_t> leader_;   // of each bin: the group that holds it
  std::vector<std::size_t> nearest_;  // of each group: the later one that it is merged with at least cost
  std::vector<float> nearest_cost_;
};

float chiTerm(float a, float b) {
  return (a - b) * (a - b) / (a + b + 1e-30f);
}

Agglomeration::Agglomeration(const SearchedWords& words)
    : groups_(words.cols()), leader_(words.cols()), nearest_(words.cols()), nearest_cost_(words.cols()) {
  std::mt19937 random(1);
  std::vector<std::vector<float>> first, second;
  std::vector<float> weight, buffer;  // near and far pairs count alike
  const auto anyWord = [&] {
    const float* bins = words.row(random() % words.rows(), buffer);
    return std::vector<float>(bins, bins + words.cols());
  };
  for (std::size_t s = 0; s < sample_pairs; ++s) {
    first.push_back(anyWord());
    second.push_back(anyWord());
    weight.push_back(1.0f / (chiSquaredFast(first[s].data(), second[s].data(), words.cols()) + 1e-6f));
  }
  std::size_t empties = words.cols();  // the first empty bin
  for (std::size_t bin = 0; bin < words.cols(); ++bin) {
    Group& group = groups_[bin];
    for (std::size_t s = 0; s < sample_pairs; ++s) {
      // Terms are homogeneous: the pair's weight can go into its values.
      group.a.push_back(first[s][bin] * weight[s]);
      group.b.push_back(second[s][bin] * weight[s]);
      group.term.push_back(chiTerm(group.a[s], group.b[s]));
    }
    // Merging bins that no sampled word has anything in costs nothing: they are one group from the start. One by one
    // they would be every other bin's nearest in turn, and each merge would look for all nearest groups again.
    const auto isZero = [](float value) { return value == 0; };
    const bool empty =
        std::all_of(group.a.begin(), group.a.end(), isZero) && std::all_of(group.b.begin(), group.b.end(), isZero);
    leader_[bin] = empty && empties < words.cols() ? empties : bin;
    if (empty && empties == words.cols()) empties = bin;
    if (leader_[bin] == bin) alive_.push_back(bin);
  }
  for (const std::size_t i : alive_) findNearestGroup(i);
}

float Agglomeration::cost(std::size_t i, std::size_t j) const {
  const Group &p = groups_[i], &q = groups_[j];
  return mergingCost({p.a.data(), p.b.data(), p.term.data()}, {q.a.data(), q.b.data(), q.term.data()}, sample_pairs);
}

void Agglomeration::findNearestGroup(std::size_t i) {
  nearest_cost_[i] = std::numeric_limits<float>::infinity();
  for (auto j = std::upper_bound(alive_.begin(), alive_.end(), i); j != alive_.end(); ++j) {
    const float c = cost(i, *j);
    if (c < nearest_cost_[i]) {
      nearest_cost_[i] = c;
      nearest_[i] = *j;
    }
  }
}

void Agglomeration::mergeCheapest() {
  const auto cheaper = [&](std::size_t a, std::size_t b) { return nearest_cost_[a] < nearest_cost_[b]; };
  const std::size_t kept = *std::min_element(alive_.begin(), alive_.end(), cheaper), gone = nearest_[kept];
  Group &group = groups_[kept], &other = groups_[gone];
  for (std::size_t s = 0; s < sample_pairs; ++s) {
    group.a[s] += other.a[s];
    group.b[s] += other.b[s];
    group.term[s] = chiTerm(group.a[s], group.b[s]);
  }
  std::replace(leader_.begin(), leader_.end(), gone, kept);
  alive_.erase(std::lower_bound(alive_.begin(), alive_.end(), gone));
  for (const std::size_t i : alive_) {
    const bool stale = i == kept || (i < gone && (nearest_[i] == kept || nearest_[i] == gone));
    if (stale) {
      findNearestGroup(i);
    } else if (i < kept) {
      const float c = cost(i, kept);
      if (c < nearest_cost_[i]) {
        nearest_cost_[i] = c;
        nearest_[i] = kept;
      }
    }
  }
}

BinMerge Agglomeration::merge() const {
  BinMerge merge;
  merge.size = alive_.size();
  for (const std::size_t leader : leader_) {
    merge.group.push_back(std::uint16_t(std::lower_bound(alive_.begin(), alive_.end(), leader) - alive_.begin()));
  }
  return merge;
}

}  // namespace

void BinMerge::apply(const float* descriptor, float* sums) const {
  std::fill(sums, sums + padded(), 0.0f);
  for (std::size_t i = 0; i < group.size(); ++i) sums[group[i]] += descriptor[i];
}

std::vector<BinMerge> learnBoundCascade(const SearchedWords& words, const std::vector<std::size_t>& sizes) {
  Agglomeration agglomeration(words);
  std::vector<BinMerge> levels;
  for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
    while (agglomeration.groups() > *size) agglomeration.mergeCheapest();
    levels.push_back(agglomeration.merge());
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

}  // namespace sks
