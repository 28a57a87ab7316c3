// SPDX-License-Identifier: BSD-3-Clause
// Normals and curvature.
#include <cmath>

#include <gtest/gtest.h>
#include <pcl/features/normal_3d.h>
#include <pcl/features/principal_curvatures.h>
#include <pcl/search/kdtree.h>

#include <sks_detector/stages/keypoints.hpp>
#include <sks_detector/stages/surface.hpp>

#include "bumps.hpp"
#include "core/keypoints/sparse_selection.hpp"
#include "pcl_clouds.hpp"
#include "synthetic.hpp"

namespace {

sks::Surface prepareScene(const sks::Cloud& cloud) {
  return sks::prepareSurface(cloud, {}, sks::Orientation::sensor, 1);
}

double angle(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / M_PI;
}

}  // namespace

TEST(Normals, EqualThoseOfPcl) {
  using sks::test::Placed;
  const sks::Cloud seen =
      sks::test::view({Placed{sks::test::roundedShape(), sks::test::poseOf(20, {1, 1, 0}, {0, 0, 0.7f})}});
  sks::Cloud object;
  for (const auto& p : seen.points) {
    if (p.allFinite()) object.points.push_back(p);
  }
  for (const sks::Cloud& cloud : {sks::test::bumps(), object}) {
    const sks::Surface surface = prepareScene(cloud);
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setInputCloud(sks::test::pclPoints(surface.positions()));
    estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
    estimation.setRadiusSearch(0.01);
    estimation.setViewPoint(0, 0, 0);
    pcl::PointCloud<pcl::Normal> expected;
    estimation.compute(expected);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (!surface.normal(i).allFinite()) continue;
      ++compared;
      EXPECT_LT(angle(surface.normal(i), expected[i].getNormalVector3fMap()), 0.5) << surface.point(i).transpose();
    }
    EXPECT_GT(compared, surface.size() * 9 / 10);
  }
}

TEST(Curvature, EqualsPclsPrincipalCurvatures) {
  const sks::Surface surface = prepareScene(sks::test::bumps());
  const auto points = sks::test::pclPoints(surface.positions());
  pcl::PrincipalCurvaturesEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalCurvatures> estimation;
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(points);
  // At points of the surface: there both use the point's own normal.
  sks::Keypoints keypoints;
  for (std::size_t i = 3; i < surface.size(); i += 37) keypoints.positions.push_back(surface.point(i));
  sks::measureCurvature(surface, keypoints, {}, {}, 1);
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    const int index = int(3 + 37 * k);
    std::vector<int> neighbors;
    std::vector<float> distances;
    tree.radiusSearch((*points)[std::size_t(index)], 0.02, neighbors, distances);
    pcl::Indices indices(neighbors.begin(), neighbors.end());
    float x, y, z, pc1, pc2;
    estimation.computePointPrincipalCurvatures(*sks::test::pclNormals(surface), index, indices, x, y, z, pc1, pc2);
    const double expected = double(pc1) * pc2;
    EXPECT_NEAR(keypoints.curvature[k], expected, 1e-4 * expected + 1e-9);
  }
}
