// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/object_crop.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sks {
namespace {

constexpr float focal = 525;
const Eigen::Vector3d half_size(0.05, 0.1, 0.05);

/// A wall at 1 m before a VGA camera, every tenth pixel without a measurement.
Cloud wall() {
  Cloud cloud;
  cloud.width = 640, cloud.height = 480;
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 640; ++column) {
      const bool lost = (row * 640 + column) % 10 == 3;
      const float z = lost ? std::numeric_limits<float>::quiet_NaN() : 1;
      cloud.points.emplace_back(z * (float(column) - 319.5f) / focal, z * (float(row) - 239.5f) / focal, z);
      cloud.colors.push_back({std::uint8_t(column % 256), std::uint8_t(row % 256), 0});
    }
  }
  return cloud;
}

Eigen::Isometry3d boxAt(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

std::size_t inside(const Cloud& cloud, const Eigen::Isometry3d& T_cloud_box) {
  std::size_t count = 0;
  for (const auto& point : cloud.points) {
    const Eigen::Vector3d p = T_cloud_box.inverse() * point.cast<double>();
    count += point.allFinite() && (p.cwiseAbs().array() <= half_size.array()).all();
  }
  return count;
}

TEST(ObjectCrop, HoldsAllThatIsInTheDirectionOfTheBox) {
  const Cloud cloud = wall();
  const Eigen::Isometry3d T_cloud_box = boxAt(0.2, -0.1, 1);
  const ObjectCrop crop = cropAround(cloud, T_cloud_box, half_size, 0);
  EXPECT_EQ(crop.stride, 1);
  EXPECT_TRUE(crop.cloud.organized());
  EXPECT_EQ(crop.cloud.size(), std::size_t(crop.cloud.width) * crop.cloud.height);
  EXPECT_EQ(crop.cloud.colors.size(), crop.cloud.size());
  EXPECT_EQ(inside(crop.cloud, T_cloud_box), inside(cloud, T_cloud_box));
  EXPECT_LT(crop.cloud.size(), cloud.size() / 12);
}

TEST(ObjectCrop, LeavesOutRowsAndColumnsUpToASpacing) {
  const ObjectCrop crop = cropAround(wall(), boxAt(0, 0, 1), half_size, 0.0045);  // pixels are 1.9 mm apart
  EXPECT_EQ(crop.stride, 2);
  float nearest = 1;
  for (std::size_t i = 1; i < crop.cloud.width; ++i) {
    const float apart = (crop.cloud.points[i] - crop.cloud.points[i - 1]).norm();
    if (std::isfinite(apart)) nearest = std::min(nearest, apart);
  }
  EXPECT_NEAR(nearest, 2 / focal, 1e-5);
  EXPECT_EQ(crop.cloud.size(), std::size_t(crop.cloud.width) * crop.cloud.height);
}

TEST(ObjectCrop, WhatIsNearerAndFartherBelongsToIt) {
  const Cloud cloud = wall();
  EXPECT_GT(cropAround(cloud, boxAt(0, 0, 0.5), half_size, 0).cloud.size(), 10000u);  // looked through
  EXPECT_GT(cropAround(cloud, boxAt(0, 0, 2), half_size, 0).cloud.size(), 1000u);     // hidden
}

TEST(ObjectCrop, IsEmptyBesideThePicture) {
  EXPECT_TRUE(cropAround(wall(), boxAt(3, 0, 1), half_size, 0).cloud.points.empty());
  EXPECT_TRUE(cropAround(wall(), boxAt(0, 0, -1), half_size, 0).cloud.points.empty());
}

TEST(ObjectCrop, TakesAllWhereTheSensorIsInTheBox) {
  const Cloud cloud = wall();
  EXPECT_EQ(inside(cropAround(cloud, boxAt(0, 0, 0.02), half_size, 0).cloud, boxAt(0, 0, 1)),
            inside(cloud, boxAt(0, 0, 1)));
}

TEST(ObjectCrop, OfAnUnorganisedCloudHoldsOnlyWhatIsInTheDirection) {
  Cloud cloud = wall();
  cloud.width = std::uint32_t(cloud.size()), cloud.height = 1;
  const Eigen::Isometry3d T_cloud_box = boxAt(0.2, -0.1, 1);
  const ObjectCrop crop = cropAround(cloud, T_cloud_box, half_size, 0.01);
  EXPECT_EQ(crop.stride, 1);
  EXPECT_EQ(inside(crop.cloud, T_cloud_box), inside(cloud, T_cloud_box));
  EXPECT_LT(crop.cloud.size(), cloud.size() / 20);
  for (const auto& point : crop.cloud.points) EXPECT_TRUE(point.allFinite());
}

}  // namespace
}  // namespace sks
