// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/average_recall.hpp"

#include <algorithm>
#include <numeric>

namespace sks {

std::size_t foundTargets(const ErrorTable& errors, double threshold) {
  const std::size_t targets = errors.empty() ? 0 : errors.front().size();
  std::vector<bool> taken(targets, false);
  std::size_t found = 0;
  for (std::size_t i = 0; i < std::min(errors.size(), targets); ++i) {
    double smallest = threshold;
    std::size_t best = targets;
    for (std::size_t k = 0; k < targets; ++k) {
      if (taken[k] || errors[i][k] >= smallest) continue;
      smallest = errors[i][k];
      best = k;
    }
    if (best == targets) continue;
    taken[best] = true;
    ++found;
  }
  return found;
}

void RecallCount::add(const RecallCount& other) {
  targets += other.targets;
  found.resize(std::max(found.size(), other.found.size()), 0);
  for (std::size_t i = 0; i < other.found.size(); ++i) found[i] += other.found[i];
}

double RecallCount::average() const {
  const std::size_t sum = std::accumulate(found.begin(), found.end(), std::size_t(0));
  return double(sum) / (double(found.size()) * double(targets));
}

RecallCount countRecall(const ErrorTable& errors, std::size_t target_count, const std::vector<double>& thresholds) {
  RecallCount count;
  count.targets = target_count;
  for (const double threshold : thresholds) count.found.push_back(foundTargets(errors, threshold));
  return count;
}

}  // namespace sks
