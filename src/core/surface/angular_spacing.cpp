// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/angular_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sks {
namespace {

constexpr std::size_t samples = 500;
constexpr double well_sampled = 4;  // spacings of points within the radius of a normal

}  // namespace

float angularSpacing(const Surface& scene, float radius) {
  std::vector<PointGrid::Run> runs;
  std::vector<float> angles;
  for (std::size_t i = 0; i < scene.size(); i += scene.size() / samples + 1) {
    float nearest = radius * radius;
    scene.forEachNeighbor(scene.point(i), radius, runs, [&](std::uint32_t, float squared) {
      if (squared > 0) nearest = std::min(nearest, squared);  // not itself, nor one that is there twice
    });
    angles.push_back(std::sqrt(nearest) / std::max((scene.point(i) - scene.sensor_origin).norm(), radius));
  }
  if (angles.empty()) return 0;
  std::nth_element(angles.begin(), angles.begin() + angles.size() / 2, angles.end());
  return angles[angles.size() / 2];
}

float sensorSpacing(const Surface& scene, float radius) {
  return angularSpacing(scene, radius) / scene.step;
}

double samplingAt(double range, double spacing, double normal_radius) {
  const double apart = range * spacing;
  return apart > 0 ? std::min(1.0, normal_radius / (well_sampled * apart)) : 1;
}

}  // namespace sks
