// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include <sks_detector/surface.hpp>

namespace sks {

/// How a place lies to what the sensor saw in its direction.
enum class Sight {
  unknown,   ///< nothing was measured there
  at,        ///< at the surface that was seen
  hidden,    ///< behind it
  in_front,  ///< in front of it: the sensor looked through this place
};

/// A scene as its sensor saw it: the nearest and the farthest point in each cell of a perspective grid, whose cells are
/// about two spacings of the points wide. Immutable once built; thread-safe.
class RangeImage {
public:
  /// @param radius within which most points have a neighbour [m]
  RangeImage(const Surface& scene, float radius);

  /// @param tolerance nearer to the seen surface than this is at it [m]
  Sight look(const Eigen::Vector3f& place, float tolerance) const;

private:
  Eigen::Vector3f project(const Eigen::Vector3f& place) const;  // (u, v, range); range < 0 behind the sensor

  Eigen::Vector3f origin_;
  Eigen::Matrix3f axes_;  // rows: u, v, and the direction of view
  float cell_ = 1;
  float u0_ = 0, v0_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<float> nearest_, farthest_;  // [m]; farthest < 0 where nothing was measured
};

}  // namespace sks
