// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/body_axis.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sks_detector/simulation/mesh.hpp>

#include "simulation/builtin_objects.hpp"

namespace sks {
namespace {

struct Oriented {
  std::vector<Eigen::Vector3f> points, normals;
};

/// About 4000 points of a mesh's faces, the same number on the same area, moved by `shift`; normals are off by `noise`
/// [rad] in each direction.
Oriented pointsOf(const Mesh& mesh, const Eigen::Vector3f& shift, float noise) {
  Oriented all;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> share(0, 1);
  std::normal_distribution<float> error(0, noise);
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += double(mesh.areaVector(t).norm());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3f across = mesh.areaVector(t);
    const double wanted = 4000 * double(across.norm()) / area;
    for (int i = 0, n = int(wanted + double(share(random))); i < n; ++i) {
      const float u = share(random), v = share(random);
      all.points.push_back((u + v > 1 ? mesh.point(t, 1 - u, 1 - v) : mesh.point(t, u, v)) + shift);
      const Eigen::Vector3f off(error(random), error(random), error(random));
      all.normals.push_back((across.normalized() + off).normalized());
    }
  }
  return all;
}

TEST(BodyAxis, OfAMugIsWhereItsBodyIsAndNotTheMiddleOfItsBox) {
  const Mesh mug = builtinObject("mug");
  const Eigen::Vector3f shift(0.03f, -0.02f, 0.05f);
  for (const float noise : {0.0f, 0.08f}) {
    const Oriented surface = pointsOf(mug, shift, noise);
    const auto body = findBodyAxis(surface.points, surface.normals);
    ASSERT_TRUE(body) << noise;
    EXPECT_EQ(body->direction, 2);
    EXPECT_NEAR(body->origin.x(), 0.03, 0.0005);  // it is made around the z axis
    EXPECT_NEAR(body->origin.y(), -0.02, 0.0005);
  }
  const Eigen::Vector3f middle = mug.box().center();
  EXPECT_GT(middle.head<2>().norm(), 0.01f);  // by the handle
}

TEST(BodyAxis, OfABottleAndABowl) {
  for (const std::string name : {"bottle", "bowl"}) {
    const Oriented surface = pointsOf(builtinObject(name), Eigen::Vector3f::Zero(), 0.05f);
    const auto body = findBodyAxis(surface.points, surface.normals);
    ASSERT_TRUE(body) << name;
    EXPECT_EQ(body->direction, 2) << name;
    EXPECT_LT(body->origin.norm(), 0.001) << name;
  }
}

TEST(BodyAxis, IsNotFoundInWhatIsNotRound) {
  for (const std::string name : {"box", "duck", "booklet", "tablet"}) {
    const Oriented surface = pointsOf(builtinObject(name), Eigen::Vector3f::Zero(), 0.05f);
    EXPECT_FALSE(findBodyAxis(surface.points, surface.normals)) << name;
  }
  EXPECT_FALSE(findBodyAxis({}, {}));
}

}  // namespace
}  // namespace sks
