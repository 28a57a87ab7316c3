// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/pcl.hpp>

#include <limits>

#include <gtest/gtest.h>

#include <sks_detector/trainer.hpp>

#include "synthetic.hpp"
#include "training_samples.hpp"

namespace {

/// Two rows of three points, of which one was not measured.
template <typename PointT>
pcl::PointCloud<PointT> organizedCloud() {
  pcl::PointCloud<PointT> cloud(3, 2);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud[i].x = float(i);
    cloud[i].y = -float(i);
    cloud[i].z = 0.5f;
  }
  cloud[4].x = cloud[4].y = cloud[4].z = std::numeric_limits<float>::quiet_NaN();
  cloud.is_dense = false;
  cloud.sensor_origin_ = Eigen::Vector4f(0.1f, 0.2f, 0.3f, 1);
  return cloud;
}

template <typename PointT>
sks::Cloud converted(const pcl::PointCloud<PointT>& from) {
  const sks::Cloud cloud = sks::fromPcl(from);
  EXPECT_TRUE(cloud.organized());
  EXPECT_EQ(cloud.width, 3u);
  EXPECT_EQ(cloud.height, 2u);
  EXPECT_EQ(cloud.sensor_origin, Eigen::Vector3f(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(cloud.size(), 6u);
  EXPECT_EQ(cloud.points.at(5), Eigen::Vector3f(5, -5, 0.5f));
  EXPECT_TRUE(cloud.points.at(4).array().isNaN().all());
  return cloud;
}

template <typename PointT>
void expectColors() {
  pcl::PointCloud<PointT> from = organizedCloud<PointT>();
  for (std::size_t i = 0; i < from.size(); ++i) {
    from[i].r = std::uint8_t(i);
    from[i].g = 100;
    from[i].b = std::uint8_t(200 + i);
  }
  const sks::Cloud cloud = converted(from);
  ASSERT_EQ(cloud.colors.size(), 6u);
  EXPECT_EQ(int(cloud.colors[3].r), 3);
  EXPECT_EQ(int(cloud.colors[3].g), 100);
  EXPECT_EQ(int(cloud.colors[3].b), 203);
}

}  // namespace

TEST(FromPcl, TakesPositionsColoursRowsAndTheSensor) {
  EXPECT_FALSE(converted(organizedCloud<pcl::PointXYZ>()).hasColor());
  EXPECT_FALSE(converted(organizedCloud<pcl::PointNormal>()).hasColor());
  expectColors<pcl::PointXYZRGB>();
  expectColors<pcl::PointXYZRGBA>();
  expectColors<pcl::PointXYZRGBNormal>();
}

TEST(FromPcl, UnorganizedCloudsStaySo) {
  pcl::PointCloud<pcl::PointXYZ> from;
  from.push_back(pcl::PointXYZ(1, 2, 3));
  from.push_back(pcl::PointXYZ(4, 5, 6));
  const sks::Cloud cloud = sks::fromPcl(from);
  EXPECT_FALSE(cloud.organized());
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.points.at(1), Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(sks::fromPcl(pcl::PointCloud<pcl::PointXYZ>()).size(), 0u);
}

TEST(FromPcl, DetectsAsInTheCloudItself) {
  const sks::Cloud view = sks::test::view(
      {sks::test::Placed{sks::test::asymmetricShape(), sks::test::poseOf(35, {1, 2, 0.5f}, {0, 0, 0.8f})}});
  pcl::PointCloud<pcl::PointXYZ> same(view.width, view.height);
  for (std::size_t i = 0; i < view.size(); ++i) same[i].getVector3fMap() = view.points[i];
  const sks::Detector detector(sks::train({sks::test::sampleOf("thing", view)}, {}, "toys"));
  const auto expected = detector.detect(view).detections, found = sks::detect(detector, same).detections;
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].object, "thing");
  EXPECT_EQ(found[0].score, expected[0].score);
  EXPECT_EQ(found[0].T_scene_model.matrix(), expected[0].T_scene_model.matrix());
}
