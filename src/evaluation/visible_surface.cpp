// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/visible_surface.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr double occlusion_tolerance = 0.015;  // delta [m]

}  // namespace

std::vector<double> visibleSurfaceDiscrepancy(const DepthMap& found, const DepthMap& truth, const SceneDepth& scene,
                                              const std::vector<double>& tolerances) {
  std::size_t either = 0, one = 0;
  std::vector<double> apart;  // distances where both are visible [m]
  std::size_t pixel = 0;
  for (int row = 0; row < scene.camera.height; ++row) {
    for (int column = 0; column < scene.camera.width; ++column, ++pixel) {
      if (found[pixel] == 0 && truth[pixel] == 0) continue;
      const double length = scene.camera.rayLength(column, row);  // of distances along the ray
      const double measured = scene.depth[pixel];
      const auto visible = [&](double depth) {
        return depth > 0 && (measured == 0 || length * (depth - measured) <= occlusion_tolerance);
      };
      const bool truth_visible = visible(truth[pixel]);
      const bool found_visible = visible(found[pixel]) || (truth_visible && found[pixel] > 0);
      either += truth_visible || found_visible;
      one += truth_visible != found_visible;
      if (truth_visible && found_visible) {
        apart.push_back(length * std::abs(double(found[pixel]) - double(truth[pixel])));
      }
    }
  }
  std::vector<double> discrepancies;
  for (const double tolerance : tolerances) {
    const auto too_far = std::count_if(apart.begin(), apart.end(), [&](double d) { return d >= tolerance; });
    discrepancies.push_back(either > 0 ? double(one + std::size_t(too_far)) / double(either) : 1);
  }
  return discrepancies;
}

}  // namespace sks
