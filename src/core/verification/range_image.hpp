// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <sks_detector/stages/surface.hpp>

namespace sks {

/// How a position lies to what the sensor saw in its direction.
enum class Sight {
  unknown,   ///< nothing was measured there
  at,        ///< at the surface that was seen
  occluded,  ///< behind it
  in_front,  ///< in front of it: the sensor looked through this position
};

constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// A scene as its sensor saw it: the nearest and the farthest point in each cell of a perspective grid, whose cells are
/// about two spacings of the points wide. Immutable once built; thread-safe.
class RangeImage {
public:
  /// All that is asked of a cell, in half a line of the cache.
  struct alignas(32) Cell {
    static constexpr float nan = std::numeric_limits<float>::quiet_NaN();

    Eigen::Vector3f position() const { return {x, y, z}; }
    Eigen::Vector3f normal() const { return {nx, ny, nz}; }

    float x = nan, y = nan, z = nan;     ///< the nearest point that has a normal [m]; NaN without any
    float nx = nan, ny = nan, nz = nan;  ///< its normal
    float nearest = std::numeric_limits<float>::infinity();  ///< range of any point [m]
    float farthest = -1;                                     ///< below 0 where nothing was measured
  };

  /// Where positions appear in the image: u and v along the first axes of `axes` over depth along the third.
  struct Projection {
    Eigen::Vector3f origin = Eigen::Vector3f::Zero();    ///< the sensor's [m]
    Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< rows: u, v, and the direction of view
    float cell = 1;                                      ///< edge of a cell
    float u0 = 0, v0 = 0;                                ///< corner of the first cell
    int width = 0, height = 0;                           ///< in cells
  };

  /// Beyond 80 degrees from the direction of view the grid would grow without bounds: cosine.
  static constexpr float rim = 0.17f;

  RangeImage() = default;  ///< of nothing: all is unknown
  /// @param radius within which most points have a neighbour [m]
  RangeImage(const Surface& scene, float radius, int threads = 1);

  /// What the sensor saw in the direction of a position.
  struct Sighting {
    Sight sight = Sight::unknown;
    const Cell* cell = nullptr;  ///< none: outside of the image

    /// Whether there is a scene point with a normal in that direction.
    bool hasPoint() const { return cell != nullptr && !std::isnan(cell->x); }
  };

  /// @param tolerance nearer to the seen surface than this is at it [m]
  Sighting look(const Eigen::Vector3f& position, float tolerance) const {
    const Eigen::Vector3f p = project(position);
    const float column = (p.x() - projection_.u0) / projection_.cell, row = (p.y() - projection_.v0) / projection_.cell;
    if (p.z() < 0 || !(column >= 0 && row >= 0 && column < float(projection_.width) && row < float(projection_.height)))
      return {};
    const Cell& cell = cells_[std::size_t(row) * std::size_t(projection_.width) + std::size_t(column)];
    if (cell.farthest < 0) return {Sight::unknown, &cell};
    if (p.z() < cell.nearest - tolerance) return {Sight::in_front, &cell};
    if (p.z() > cell.farthest + tolerance) return {Sight::occluded, &cell};
    return {Sight::at, &cell};
  }

  /// Index of the scene point of a sighting; `no_point` without any.
  std::uint32_t pointOf(const Sighting& sighting) const {
    return sighting.cell == nullptr ? no_point : points_[std::size_t(sighting.cell - cells_.data())];
  }

  /// Index of the scene point that a cell holds; `no_point` without any.
  std::uint32_t pointAt(std::size_t cell) const { return points_[cell]; }

  const Projection& projection() const { return projection_; }
  /// Median angle between neighbouring measurements of the sensor, of which the scene may hold only some [rad].
  float sensorSpacing() const { return sensor_spacing_; }
  /// Row by row.
  const std::vector<Cell>& cells() const { return cells_; }

private:
  /// (u, v, range); range < 0 behind the sensor and beyond the rim
  Eigen::Vector3f project(const Eigen::Vector3f& position) const {
    const Eigen::Vector3f p = projection_.axes * (position - projection_.origin);
    const float range = p.norm();
    if (p.z() <= rim * range || range == 0) return {0, 0, -1};
    return {p.x() / p.z(), p.y() / p.z(), range};
  }

  Projection projection_;
  float sensor_spacing_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> points_;  // of the cells
};

using Sighting = RangeImage::Sighting;

}  // namespace sks
