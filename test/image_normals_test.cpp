// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/image_normals.hpp"
#include "core/surface/normals.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <sks_detector/stages/surface.hpp>

#include "core/surface/pinhole_fit.hpp"
#include "core/surface/sanitize.hpp"
#include "synthetic.hpp"

namespace {

/// An organised view of an object with depth edges, and a hole in the image.
sks::Cloud objectImage() {
  sks::Cloud cloud = sks::test::view(
      {{sks::test::asymmetricShape(), sks::test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}}, 0.0025f, 160, 120);
  for (std::size_t i = 50; i < 60; ++i) cloud.points[60 * cloud.width + i].setConstant(std::nanf(""));
  return cloud;
}

std::vector<Eigen::Vector3f> normalsOf(const sks::Cloud& cloud, int threads = 1, std::uint32_t step = 1) {
  std::vector<Eigen::Vector3f> normals;
  EXPECT_TRUE(sks::imageNormals(cloud, *sks::fitPinhole(cloud, threads), step, {}, threads, normals));
  return normals;
}

}  // namespace

TEST(ImageNormals, AreThoseOfAllNeighborsWithinTheRadius) {
  const sks::Cloud cloud = sks::sanitize(objectImage(), {});
  ASSERT_GT(cloud.size(), 3000u);
  const auto normals = normalsOf(cloud);
  sks::Surface surface = sks::makeSurface(cloud, 0.01);
  sks::estimateNormals(surface, {}, sks::Orientation::sensor, 1);
  ASSERT_EQ(normals.size(), surface.size());
  std::size_t known = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f& normal = normals[surface.source[i]];
    ASSERT_EQ(normal.allFinite(), surface.normal(i).allFinite()) << i;
    if (!normal.allFinite()) continue;
    ++known;
    EXPECT_NEAR(std::abs(normal.dot(surface.normal(i))), 1, 1e-4) << i;
  }
  EXPECT_GT(known, 3000u);
}

TEST(ImageNormals, AreTheSameForAnyThreads) {
  const sks::Cloud cloud = sks::sanitize(objectImage(), {});
  const auto one = normalsOf(cloud, 1), three = normalsOf(cloud, 3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].allFinite()) {
      EXPECT_EQ(one[i], three[i]);
    }
  }
}

TEST(ImageNormals, OfEveryThirdRowAndColumnUseAllNeighbors) {
  const sks::Cloud cloud = sks::sanitize(objectImage(), {});
  const auto all = normalsOf(cloud), few = normalsOf(cloud, 2, 3);
  std::size_t k = 0, known = 0, same = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.pixels[i] / cloud.columns % 3 != 0 || cloud.pixels[i] % cloud.columns % 3 != 0) continue;
    ASSERT_LT(k, few.size());
    const Eigen::Vector3f& normal = few[k++];
    ASSERT_EQ(normal.allFinite(), all[i].allFinite()) << i;
    if (!normal.allFinite()) continue;
    ++known;
    same += std::abs(normal.dot(all[i])) > 0.9999f;
  }
  EXPECT_EQ(k, few.size());
  EXPECT_GT(known, 300u);
  EXPECT_GE(same + 2, known);  // of few neighbours in one line any rounding decides
}

TEST(ImageNormals, AreLeftToTheGridWhereThePixelsAreNoCamerasInTheFrameOfThePoints) {
  const sks::Cloud turned = sks::test::transformed(objectImage(), sks::test::poseOf(40, {1, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(sks::fitPinhole(sks::sanitize(turned, {}), 1));
  sks::Cloud unorganized = objectImage();
  unorganized.width *= unorganized.height;
  unorganized.height = 1;
  EXPECT_FALSE(sks::fitPinhole(sks::sanitize(unorganized, {}), 1));
}

TEST(PinholeFit, FindsTheCamera) {
  sks::Cloud cloud;
  cloud.width = 60;
  cloud.height = 40;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 60; ++column) {
      const float z = 1 + 0.01f * float((row * 7 + column * 3) % 20);
      cloud.points.emplace_back((float(column) - 31.5f) / 525 * z, (float(row) - 18) / 520 * z, z);
    }
  }
  const auto camera = sks::fitPinhole(sks::sanitize(cloud, {}), 1);
  ASSERT_TRUE(camera);
  EXPECT_NEAR(camera->focal_x, 525, 0.1);
  EXPECT_NEAR(camera->focal_y, 520, 0.1);
  EXPECT_NEAR(camera->center_x, 31.5, 0.01);
  EXPECT_NEAR(camera->center_y, 18, 0.01);
  EXPECT_LT(camera->deviation, 0.01);
  EXPECT_NEAR(camera->nearest, 1, 1e-6);

  cloud.points[500].x() += 0.01f;  // five pixels beside its own
  EXPECT_FALSE(sks::fitPinhole(sks::sanitize(cloud, {}), 1));
}
