// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/iss_keypoints.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <pcl/keypoints/iss_3d.h>
#include <pcl/search/kdtree.h>

#include "bumps.hpp"
#include "pcl_clouds.hpp"
#include "prepared.hpp"
#include "synthetic.hpp"

namespace sks::test {
namespace {

using Positions = std::set<std::array<float, 3>>;

Positions issOfPcl(const Surface& surface, const KeypointSettings& settings) {
  pcl::ISSKeypoint3D<pcl::PointXYZ, pcl::PointXYZ> detector;
  detector.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  detector.setInputCloud(pclPoints(surface.positions()));
  detector.setSalientRadius(settings.iss_salient_radius);
  detector.setNonMaxRadius(settings.iss_suppression_radius);
  detector.setThreshold21(settings.iss_gamma_21);
  detector.setThreshold32(settings.iss_gamma_32);
  detector.setMinNeighbors(settings.iss_min_neighbors);
  detector.setNumberOfThreads(1);
  pcl::PointCloud<pcl::PointXYZ> found;
  detector.compute(found);
  Positions positions;
  for (const pcl::PointXYZ& p : found) positions.insert({p.x, p.y, p.z});
  return positions;
}

void expectLikePcl(const Surface& surface, const KeypointSettings& settings) {
  Positions ours;
  for (const Eigen::Vector3f& p : issKeypoints(surface, settings, 2).positions) ours.insert({p.x(), p.y(), p.z()});
  const Positions theirs = issOfPcl(surface, settings);
  Positions both;
  std::set_intersection(ours.begin(), ours.end(), theirs.begin(), theirs.end(), std::inserter(both, both.end()));
  EXPECT_GT(theirs.size(), 5u);
  EXPECT_GE(double(both.size()), 0.99 * double(std::max(ours.size(), theirs.size())))
      << ours.size() << " of ours, " << theirs.size() << " of PCL, " << both.size() << " of both";
}

TEST(IssKeypoints, AreThoseOfPclOnASmoothSurface) {
  const Surface surface = makeSurface(bumps(), 0.01);
  KeypointSettings settings;
  expectLikePcl(surface, settings);
  settings.iss_salient_radius = 0.03;
  settings.iss_suppression_radius = 0.02;
  settings.iss_min_neighbors = 20;
  expectLikePcl(surface, settings);
}

TEST(IssKeypoints, AreThoseOfPclInAScene) {
  const Shape wall{{Solid::Shape::box, {0, 0, 0}, {0.6f, 0.4f, 0.01f}}};
  Cloud scene = view({{wall, poseOf(20, {0, 1, 0}, {0, 0, 1.3f})},
                      {asymmetricShape(), poseOf(35, {1, 2, 0.5f}, {-0.1f, 0.05f, 0.9f})},
                      {roundedShape(), poseOf(70, {0, 1, 0.5f}, {0.15f, 0.05f, 1.0f})}},
                     0.0025f, 320, 240);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.001f);  // without it rounding chooses among the points of the wall
  for (Eigen::Vector3f& p : scene.points) p *= 1 + noise(random);
  expectLikePcl(prepared(scene), KeypointSettings());
}

TEST(IssKeypoints, AreThoseOfPclAmongRandomPoints) {
  expectLikePcl(makeSurface(randomCloud(5000, 0.15f, 3), 0.01), KeypointSettings());
}

}  // namespace
}  // namespace sks::test
