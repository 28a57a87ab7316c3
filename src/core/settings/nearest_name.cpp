// SPDX-License-Identifier: BSD-3-Clause
#include "core/settings/nearest_name.hpp"

#include <algorithm>

#include "core/settings/edit_distance.hpp"

namespace sks {

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  const auto nearer = [&](const std::string& a, const std::string& b) {
    return editDistance(name, a) < editDistance(name, b);
  };
  const auto nearest = std::min_element(candidates.begin(), candidates.end(), nearer);
  return nearest == candidates.end() ? std::string() : *nearest;
}

}  // namespace sks
