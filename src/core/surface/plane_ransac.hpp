// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

namespace sks {

/// Points with unit normals, side by side.
struct OrientedPoints {
  std::size_t size() const { return x.size(); }
  Eigen::Vector3f point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Eigen::Vector3f normal(std::size_t i) const { return {nx[i], ny[i], nz[i]}; }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal);

  std::vector<float> x, y, z, nx, ny, nz;
};

/// When a point belongs to a plane.
struct PlaneTolerance {
  float distance;   ///< less than this from it, to either side [m]
  float agreement;  ///< cosine of the angle between the normals above this
};

/// The points p with normal . p = offset.
struct InfinitePlane {
  bool contains(const Eigen::Vector3f& point, const Eigen::Vector3f& point_normal,
                const PlaneTolerance& tolerance) const;

  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float offset = 0;  ///< [m]
};

/// A plane and the points that belong to it.
struct SupportedPlane {
  InfinitePlane plane;
  std::vector<std::uint32_t> members;  ///< ascending
};

/// The least-squares plane of points.
struct PlaneFit {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();     ///< of either sign
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();  ///< along the principal axes, ascending [m^2]

  /// The shorter edge of a rectangle with these variances [m].
  float smallerExtent() const;
};

/// @param points at least one
PlaneFit leastSquaresPlane(const std::vector<Eigen::Vector3f>& points);

/// RANSAC: of planes through random points, at right angles to their normals, the one that most points belong to,
/// fitted to these by least squares. The same for any number of threads.
/// @param points at least one
/// @param fewest members of a plane; what has less is not fitted further
SupportedPlane mostSupportedPlane(const OrientedPoints& points, const PlaneTolerance& tolerance, std::size_t fewest,
                                  std::mt19937& random, int threads);

}  // namespace sks
