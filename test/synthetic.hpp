// SPDX-License-Identifier: BSD-3-Clause
// Clouds of known geometry, so that tests of the stages need no data.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <sks_detector/cloud.hpp>

namespace sks::test {

/// An axis-aligned box or ellipsoid.
struct Solid {
  enum class Shape { box, ellipsoid };

  Shape shape = Shape::box;
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< [m]
  Eigen::Vector3f half = Eigen::Vector3f::Ones();    ///< half extents [m]

  bool contains(const Eigen::Vector3f& p) const;
  /// Distance along the ray to where it enters; negative if it misses. `direction` need not be a unit vector.
  float hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  /// Points on the whole surface, about `spacing` apart.
  std::vector<Eigen::Vector3f> sample(float spacing) const;
};

/// A union of solids.
using Shape = std::vector<Solid>;

bool contains(const Shape& shape, const Eigen::Vector3f& p);

/// Boxes and ellipsoids of about 0.2 m, alike from no two sides; its box is not centred at the origin.
Shape asymmetricShape();
/// Another one, of rounder parts.
Shape roundedShape();
/// An open cup with walls of 16 mm: a concave shape with an inside that only some directions see.
Shape cupShape();
/// An L of two boxes.
Shape angleShape();

/// The whole surface of a shape, about `spacing` apart: a full model. Coloured by place if asked for.
Cloud model(const Shape& shape, float spacing, bool color = false);

/// A shape at a place in front of the camera.
struct Placed {
  Shape shape;
  Eigen::Isometry3f T_camera_shape;
};

/// What a camera at the origin that looks along +z sees: organised, 2.5-D, NaN where nothing is hit.
/// @param pixel angle between pixels [rad]
Cloud view(const std::vector<Placed>& scene, float pixel = 0.0025f, std::uint32_t width = 160,
           std::uint32_t height = 120, bool color = false);

Cloud sphere(float radius, float spacing, const Eigen::Vector3f& center = Eigen::Vector3f::Zero());
Cloud torus(float ring_radius, float tube_radius, float spacing);
/// A square of the given edge at z = 1 around the optical axis.
Cloud plane(float edge, float spacing);
Cloud randomCloud(std::size_t size, float extent, std::uint32_t seed);

/// An unorganised cloud of these points.
Cloud makeCloud(std::vector<Eigen::Vector3f> points);
/// Points and sensor origin moved by T.
Cloud transformed(const Cloud& cloud, const Eigen::Isometry3f& T);
/// The points of all, one after the other; the sensor origin of the first.
Cloud merged(const std::vector<Cloud>& clouds);
Cloud shuffled(const Cloud& cloud, std::uint32_t seed);

/// A pose from a rotation about `axis` by `degrees` and a translation.
Eigen::Isometry3f poseOf(float degrees, const Eigen::Vector3f& axis, const Eigen::Vector3f& translation);
/// Angle between two rotations.
double angleDegrees(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

}  // namespace sks::test
