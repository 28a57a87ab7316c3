// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/otsu.hpp"

#include <algorithm>
#include <cmath>

namespace sks {

double otsuThreshold(const std::vector<float>& values) {
  std::vector<double> logs;
  for (const float value : values) {
    if (value > 0) logs.push_back(std::log(double(value)));
  }
  if (logs.empty()) return 0;
  const auto [low, high] = std::minmax_element(logs.begin(), logs.end());
  const double origin = *low, width = *high - *low;
  if (width <= 0) return 0;

  constexpr int bins = 256;
  std::vector<double> histogram(bins, 0.0);
  for (const double value : logs) histogram[std::min(bins - 1, int((value - origin) / width * bins))] += 1;
  double sum = 0;
  for (int i = 0; i < bins; ++i) sum += i * histogram[i];
  double below = 0, sum_below = 0, best = -1;
  int cut = 0;
  for (int i = 0; i + 1 < bins; ++i) {
    below += histogram[i];
    sum_below += i * histogram[i];
    const double above = double(logs.size()) - below;
    if (below == 0 || above == 0) continue;
    const double difference = sum_below / below - (sum - sum_below) / above;
    const double between = below * above * difference * difference;
    if (between > best) {
      best = between;
      cut = i + 1;
    }
  }
  return std::exp(origin + width * cut / bins);
}

}  // namespace sks
