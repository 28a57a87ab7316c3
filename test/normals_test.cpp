// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include <sks_detector/stages/surface.hpp>

#include "bumps.hpp"
#include "synthetic.hpp"

namespace {

sks::Surface prepare(const sks::Cloud& cloud, double radius, sks::Orientation orientation = sks::Orientation::sensor,
                     int threads = 1) {
  sks::SurfaceSettings settings;
  settings.normal_radius = radius;
  return sks::prepareSurface(cloud, settings, orientation, threads);
}

double angle(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / M_PI;
}

/// Share of the points from which a step along the normal leads out of the shape and one against it leads in.
double outwardShare(const sks::test::Shape& shape, double radius) {
  const sks::Surface surface = prepare(sks::test::model(shape, 0.003f), radius, sks::Orientation::outward, 2);
  std::size_t outward = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f step = 0.004f * surface.normal(i);
    outward += !contains(shape, surface.point(i) + step) && contains(shape, surface.point(i) - step);
  }
  return double(outward) / double(surface.size());
}

}  // namespace

TEST(Normals, OfAPlaneFaceTheSensorFromAnyPlace) {
  for (const Eigen::Vector3f& sensor : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, 0, 2),
                                        Eigen::Vector3f(3, -1, 0.9f), Eigen::Vector3f(-2, 5, 1.1f)}) {
    sks::Cloud cloud = sks::test::plane(0.1f, 0.003f);
    cloud.sensor_origin = sensor;
    const sks::Surface surface = prepare(cloud, 0.01);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      EXPECT_LT(angle(surface.normal(i), Eigen::Vector3f(0, 0, sensor.z() < 1 ? -1 : 1)), 0.01);
    }
  }
}

TEST(Normals, OfATiltedFarPlaneAreExact) {
  const Eigen::Isometry3f T = sks::test::poseOf(33, {1, 2, 0.5f}, {1.5f, -2, 5});
  const sks::Cloud cloud = sks::test::transformed(sks::test::plane(0.1f, 0.003f), T);
  const sks::Surface surface = prepare(cloud, 0.01);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    EXPECT_LT(angle(surface.normal(i), -(T.linear() * Eigen::Vector3f::UnitZ())), 0.1);
  }
}

TEST(Normals, OfASphereSeenFromInsideAndOutside) {
  const Eigen::Vector3f center(0.2f, -0.1f, 1);
  sks::Cloud cloud = sks::test::sphere(0.1f, 0.003f, center);
  for (const bool inside : {false, true}) {
    cloud.sensor_origin = inside ? center : Eigen::Vector3f(0, 0, 0);
    const sks::Surface surface = prepare(cloud, 0.01);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const Eigen::Vector3f radial = (surface.point(i) - center).normalized();
      EXPECT_LT(std::min(angle(surface.normal(i), radial), angle(surface.normal(i), -radial)), 1.0);
      EXPECT_GE(surface.normal(i).dot(cloud.sensor_origin - surface.point(i)), 0);
      EXPECT_NEAR(surface.normal(i).norm(), 1, 1e-5);
      if (inside) {
        EXPECT_LT(angle(surface.normal(i), -radial), 1.0);
      }
    }
  }
}

TEST(Normals, OfAFullSpherePointOutward) {
  const Eigen::Vector3f center(1, 2, 3);
  const sks::Surface surface = prepare(sks::test::sphere(0.08f, 0.003f, center), 0.01, sks::Orientation::outward);
  EXPECT_EQ(surface.orientation, sks::Orientation::outward);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    EXPECT_LT(angle(surface.normal(i), surface.point(i) - center), 1.5);
  }
}

TEST(Normals, OfATorusPointOutwardAroundItsHole) {
  const float ring = 0.06f;
  const sks::Surface surface = prepare(sks::test::torus(ring, 0.025f, 0.003f), 0.008, sks::Orientation::outward);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f p = surface.point(i), core = Eigen::Vector3f(p.x(), p.y(), 0).normalized() * ring;
    EXPECT_LT(angle(surface.normal(i), p - core), 4) << p.transpose();
  }
}

TEST(Normals, OfFullModelsPointOutward) {
  using sks::test::Solid;
  EXPECT_GE(outwardShare({{Solid::Shape::box, {0.3f, 0, 0}, {0.08f, 0.05f, 0.03f}}}, 0.008), 0.999);
  EXPECT_GE(outwardShare(sks::test::angleShape(), 0.008), 0.995);
  EXPECT_GE(outwardShare(sks::test::cupShape(), 0.006), 0.995);
  EXPECT_GE(outwardShare(sks::test::asymmetricShape(), 0.008), 0.995);
}

TEST(Normals, NeedEnoughNeighbors) {
  sks::Cloud cloud = sks::test::plane(0.05f, 0.003f);
  cloud.points.emplace_back(1.0f, 0.0f, 1.0f);  // alone
  for (int i = 0; i < 4; ++i) cloud.points.emplace_back(-1.0f + 0.002f * float(i % 2), 0.002f * float(i / 2), 1.0f);
  cloud.width = std::uint32_t(cloud.size());
  for (const auto orientation : {sks::Orientation::sensor, sks::Orientation::outward}) {
    const sks::Surface surface = prepare(cloud, 0.01, orientation);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const bool few = std::abs(surface.x[i]) > 0.5f;  // five are needed
      EXPECT_EQ(std::isnan(surface.nx[i]), few);
      EXPECT_EQ(std::isnan(surface.ny[i]), few);
      EXPECT_EQ(std::isnan(surface.nz[i]), few);
    }
  }
}

TEST(Normals, DoNotDependOnThreads) {  // trap 9
  const sks::Cloud cloud = sks::test::model(sks::test::asymmetricShape(), 0.004f);
  for (const auto orientation : {sks::Orientation::sensor, sks::Orientation::outward}) {
    const sks::Surface one = prepare(cloud, 0.01, orientation, 1);
    for (const int threads : {2, 5}) {
      const sks::Surface more = prepare(cloud, 0.01, orientation, threads);
      for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one.normal(i), more.normal(i));
    }
  }
}

// Squares of such distances vanish.
TEST(Normals, OfAModelOfNoSizeAreThereOrNot) {
  for (const float spacing : {1e-44f, 1e-30f, 1e-20f, 1e-10f}) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 400; ++i) points.emplace_back(spacing * float(i % 20), spacing * float(i / 20), 0.0f);
    const sks::Surface one = prepare(sks::test::makeCloud(points), 0.01, sks::Orientation::outward, 1);
    ASSERT_EQ(one.size(), points.size());
    for (const int threads : {2, 16}) {
      const sks::Surface more = prepare(sks::test::makeCloud(points), 0.01, sks::Orientation::outward, threads);
      EXPECT_EQ(more.source, one.source) << spacing;
    }
  }
}
