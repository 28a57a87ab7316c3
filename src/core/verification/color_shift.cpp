// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/color_shift.hpp"

#include <algorithm>
#include <utility>

namespace sks {
namespace {

const Eigen::Array3f most(0.3f, 0.125f, 0.125f);  // scaled: 30 units of lightness, 15 of a and b

/// @param values with their weights, whose sum is positive
float weightedMedian(std::vector<std::pair<float, double>> values) {
  std::sort(values.begin(), values.end());
  double total = 0, below = 0;
  for (const auto& [value, weight] : values) total += weight;
  for (const auto& [value, weight] : values) {
    below += weight;
    if (below >= 0.5 * total) return value;
  }
  return values.back().first;
}

}  // namespace

Eigen::Vector3f sceneColorShift(const std::vector<Examined>& examined, double doubt) {
  Eigen::Array3f shift;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<float, double>> values{{0.0f, doubt}};
    for (const Examined& candidate : examined) {
      const double evidence = candidate.hypothesis.evidence;
      if (!candidate.lines.color_shift || evidence < 0.5 * doubt) continue;
      values.emplace_back((*candidate.lines.color_shift)[axis], evidence);
    }
    shift[axis] = weightedMedian(std::move(values));
  }
  return shift.max(-most).min(most);
}

}  // namespace sks
