// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/nearest_name.hpp"

#include <algorithm>

#include "core/settings/edit_distance.hpp"
#include "core/settings/shown_text.hpp"

namespace sks {
namespace {

constexpr std::size_t least_beginning = 3;  // characters

}  // namespace

bool mayMean(const std::string& name, const std::string& candidate) {
  const bool begins = name.size() >= least_beginning && candidate.compare(0, name.size(), name) == 0;
  return begins || 2 * editDistance(name, candidate) < std::max(name.size(), candidate.size());
}

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string* nearest = nullptr;
  std::size_t smallest = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(name, candidate);
    if ((nearest != nullptr && distance >= smallest) || !mayMean(name, candidate)) continue;
    nearest = &candidate;
    smallest = distance;
  }
  return nearest == nullptr ? std::string() : *nearest;
}

std::string nearestNameHint(const std::string& name, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "there are none";
  const std::string nearest = nearestName(name, candidates);
  return nearest.empty() ? "there are: " + shownList(candidates) : "did you mean '" + shown(nearest) + "'?";
}

}  // namespace sks
