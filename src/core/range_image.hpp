// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
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

constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// What the sensor saw in the direction of a place.
struct Sighting {
  Sight sight = Sight::unknown;
  std::uint32_t point = no_point;  ///< the nearest scene point with a normal in that direction, if there is one
};

/// A scene as its sensor saw it: the nearest and the farthest point in each cell of a perspective grid, whose cells are
/// about two spacings of the points wide. Immutable once built; thread-safe.
class RangeImage {
public:
  RangeImage() = default;  ///< of nothing: all is unknown
  /// @param radius within which most points have a neighbour [m]
  RangeImage(const Surface& scene, float radius);

  /// @param tolerance nearer to the seen surface than this is at it [m]
  Sighting look(const Eigen::Vector3f& place, float tolerance) const;

private:
  Eigen::Vector3f project(const Eigen::Vector3f& place) const;  // (u, v, range); range < 0 behind the sensor

  Eigen::Vector3f origin_ = Eigen::Vector3f::Zero();
  Eigen::Matrix3f axes_ = Eigen::Matrix3f::Identity();  // rows: u, v, and the direction of view
  float cell_ = 1;
  float u0_ = 0, v0_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<std::uint32_t> points_;      // with a normal, the nearest of each cell
  std::vector<float> nearest_, farthest_;  // [m]; farthest < 0 where nothing was measured
};

}  // namespace sks
