// SPDX-License-Identifier: BSD-3-Clause
#include "core/matching/background_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace sks {
namespace {

constexpr float camera_distance = 0.8f;                         // [m] from the middle of a thing
constexpr float pixel = 0.0025f / 0.8f;                         // tangent: a point each 2.5 mm
constexpr float table_margin = 0.08f, table_thickness = 0.01f;  // [m]
constexpr float missed = std::numeric_limits<float>::infinity();

/// A convex body along the axes of its thing.
struct Primitive {
  enum Kind { box, ellipsoid, cylinder } kind;
  Eigen::Vector3f center;  // [m]
  Eigen::Vector3f half;    // [m] half of the extent along each axis; cylinders stand along z and are round
};

using Thing = std::vector<Primitive>;

Thing boxOf(float x, float y, float z) {
  return {{Primitive::box, {0, 0, 0}, {0.5f * x, 0.5f * y, 0.5f * z}}};
}
Thing canOf(float radius, float height) {
  return {{Primitive::cylinder, {0, 0, 0}, {radius, radius, 0.5f * height}}};
}
Thing ballOf(float x, float y, float z) {
  return {{Primitive::ellipsoid, {0, 0, 0}, {0.5f * x, 0.5f * y, 0.5f * z}}};
}

std::vector<Thing> things() {
  const auto on_top = [](Thing below, const Primitive& above) {
    below.push_back(above);
    return below;
  };
  const auto beside = on_top;
  return {
      boxOf(0.03f, 0.03f, 0.03f),
      boxOf(0.06f, 0.045f, 0.025f),
      boxOf(0.1f, 0.07f, 0.03f),
      boxOf(0.16f, 0.05f, 0.2f),
      boxOf(0.25f, 0.18f, 0.05f),
      boxOf(0.08f, 0.08f, 0.2f),
      boxOf(0.015f, 0.015f, 0.2f),
      canOf(0.012f, 0.15f),
      canOf(0.025f, 0.08f),
      canOf(0.035f, 0.1f),
      canOf(0.05f, 0.15f),
      canOf(0.08f, 0.06f),
      ballOf(0.04f, 0.04f, 0.04f),
      ballOf(0.07f, 0.07f, 0.07f),
      ballOf(0.12f, 0.12f, 0.12f),
      ballOf(0.09f, 0.05f, 0.05f),
      ballOf(0.2f, 0.1f, 0.08f),
      // bottles
      on_top(canOf(0.035f, 0.12f), {Primitive::cylinder, {0, 0, 0.085f}, {0.014f, 0.014f, 0.025f}}),
      on_top(ballOf(0.09f, 0.06f, 0.14f), {Primitive::cylinder, {0, 0, 0.075f}, {0.015f, 0.015f, 0.025f}}),
      // steps, heads, handles
      on_top(boxOf(0.12f, 0.08f, 0.04f), {Primitive::box, {0.02f, 0, 0.04f}, {0.03f, 0.04f, 0.02f}}),
      on_top(boxOf(0.07f, 0.05f, 0.08f), {Primitive::ellipsoid, {0, 0, 0.06f}, {0.03f, 0.025f, 0.03f}}),
      on_top(ballOf(0.1f, 0.07f, 0.07f), {Primitive::ellipsoid, {0.04f, 0, 0.04f}, {0.025f, 0.025f, 0.025f}}),
      beside(canOf(0.04f, 0.1f), {Primitive::box, {0.05f, 0, 0}, {0.02f, 0.006f, 0.03f}}),
      beside(canOf(0.015f, 0.18f), {Primitive::box, {0.04f, 0, 0.07f}, {0.06f, 0.02f, 0.015f}}),
  };
}

float alongBox(const Eigen::Vector3f& o, const Eigen::Vector3f& d, const Eigen::Vector3f& half) {
  float enter = 0, leave = missed;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / d[axis];
    const float a = (-half[axis] - o[axis]) * inverse, b = (half[axis] - o[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : missed;
}

/// Where the ray enters the unit sphere, or the unit circle of its first `axes` coordinates.
float alongRound(const Eigen::Vector3f& o, const Eigen::Vector3f& d, int axes) {
  const float a = d.head(axes).squaredNorm(), b = o.head(axes).dot(d.head(axes)), c = o.head(axes).squaredNorm() - 1;
  const float discriminant = b * b - a * c;
  return discriminant >= 0 && a > 0 ? (-b - std::sqrt(discriminant)) / a : missed;
}

float alongCylinder(const Eigen::Vector3f& o, const Eigen::Vector3f& d) {
  const float side = alongRound(o, d, 2);
  if (side != missed && std::abs(o.z() + side * d.z()) <= 1) return side;
  const float cap = ((d.z() < 0 ? 1.0f : -1.0f) - o.z()) / d.z();
  return (o + cap * d).head<2>().squaredNorm() <= 1 ? cap : missed;
}

/// Distance along a ray from outside, in lengths of its direction.
float along(const Primitive& primitive, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
  const Eigen::Vector3f o = origin - primitive.center;
  if (primitive.kind == Primitive::box) return alongBox(o, direction, primitive.half);
  const Eigen::Vector3f unit_o = o.cwiseQuotient(primitive.half), unit_d = direction.cwiseQuotient(primitive.half);
  return primitive.kind == Primitive::ellipsoid ? alongRound(unit_o, unit_d, 3) : alongCylinder(unit_o, unit_d);
}

/// The thing on a table, of which a hand's breadth around it is seen.
Thing onTable(Thing thing) {
  float bottom = 0, radius = 0;
  for (const Primitive& p : thing) {
    bottom = std::min(bottom, p.center.z() - p.half.z());
    radius = std::max(radius, (p.center + p.half).head<2>().norm());
  }
  const float half = radius + table_margin;
  thing.push_back({Primitive::box, {0, 0, bottom - table_thickness}, {half, half, table_thickness}});
  return thing;
}

/// @param elevation,azimuth of the camera around the thing [rad]
Cloud viewOf(const Thing& thing, float elevation, float azimuth) {
  Eigen::Isometry3f T_thing_camera = Eigen::Isometry3f::Identity();  // looks along z
  T_thing_camera.linear() = (Eigen::AngleAxisf(azimuth, Eigen::Vector3f::UnitZ()) *
                             Eigen::AngleAxisf(float(-0.5 * EIGEN_PI) - elevation, Eigen::Vector3f::UnitX()))
                                .toRotationMatrix();
  T_thing_camera.translation() = -camera_distance * T_thing_camera.linear().col(2);
  float radius = 0;
  for (const Primitive& p : thing) radius = std::max(radius, p.center.norm() + p.half.norm());
  const int reach = int(radius / camera_distance / pixel) + 1;
  Cloud cloud;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const Eigen::Vector3f ray(float(column) * pixel, float(row) * pixel, 1);
      const Eigen::Vector3f direction = T_thing_camera.linear() * ray;
      float nearest = missed;
      for (const Primitive& primitive : thing) {
        nearest = std::min(nearest, along(primitive, T_thing_camera.translation(), direction));
      }
      if (nearest < missed) cloud.points.push_back(nearest * ray);
    }
  }
  return cloud;
}

}  // namespace

std::size_t backgroundThings() {
  return things().size();
}

std::vector<Cloud> backgroundViews(std::size_t thing) {
  constexpr float low = 0.35f, high = 0.9f;  // [rad] 20 and 52 degrees, as cameras look at tables
  const Thing free = things()[thing], standing = onTable(free);
  std::vector<Cloud> views;
  for (const float azimuth : {0.4f, 1.2f}) {
    views.push_back(viewOf(free, low, azimuth));
    views.push_back(viewOf(standing, high, azimuth));
  }
  return views;
}

}  // namespace sks
