// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace sks {

/// Points of which the farthest in one direction after another is asked for.
class FarthestPoint {
public:
  /// @param points at least one
  explicit FarthestPoint(const std::vector<Eigen::Vector3f>& points);

  /// Of several that are as far, one that is the same each time.
  Eigen::Vector3f along(const Eigen::Vector3f& direction) const;

private:
  std::vector<float> x_, y_, z_;  // padded with copies of the last point to whole SIMD vectors
};

}  // namespace sks
