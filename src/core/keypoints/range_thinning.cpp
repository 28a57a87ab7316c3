// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/range_thinning.hpp"

#include "core/surface/angular_spacing.hpp"

namespace sks {

Keypoints thinnedByRange(const Keypoints& keypoints, const Surface& scene, double normal_radius) {
  const double spacing = double(sensorSpacing(scene, float(normal_radius)));
  Keypoints kept;
  double owed = 0;  // keypoints lie row by row, so what one of them is short of counts for the next one
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const double range = double((keypoints.positions[i] - scene.sensor_origin).norm());
    const double sampling = samplingAt(range, spacing, normal_radius);
    owed += sampling * sampling;
    if (owed < 1) continue;
    owed -= 1;
    kept.positions.push_back(keypoints.positions[i]);
    if (!keypoints.normals.empty()) kept.normals.push_back(keypoints.normals[i]);
    if (!keypoints.curvature.empty()) kept.curvature.push_back(keypoints.curvature[i]);
  }
  return kept;
}

}  // namespace sks
