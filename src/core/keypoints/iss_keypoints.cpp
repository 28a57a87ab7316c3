// SPDX-License-Identifier: BSD-3-Clause
#include "core/keypoints/iss_keypoints.hpp"

#include <algorithm>

#include <pcl/keypoints/iss_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

namespace sks {

Keypoints issKeypoints(const Surface& surface, const KeypointSettings& settings, int threads) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(surface.size());
  for (std::size_t i = 0; i < surface.size(); ++i) cloud->push_back({surface.x[i], surface.y[i], surface.z[i]});

  pcl::ISSKeypoint3D<pcl::PointXYZ, pcl::PointXYZ> detector;
  detector.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  detector.setInputCloud(cloud);
  detector.setSalientRadius(settings.iss_salient_radius);
  detector.setNonMaxRadius(settings.iss_suppression_radius);
  detector.setThreshold21(settings.iss_gamma_21);
  detector.setThreshold32(settings.iss_gamma_32);
  detector.setMinNeighbors(settings.iss_min_neighbors);
  detector.setNumberOfThreads(unsigned(threads));
  pcl::PointCloud<pcl::PointXYZ> found;
  detector.compute(found);

  // PCL's threads append in any order.
  std::vector<int> indices(detector.getKeypointsIndices()->indices.begin(),
                           detector.getKeypointsIndices()->indices.end());
  std::sort(indices.begin(), indices.end());
  Keypoints keypoints;
  for (const int i : indices) keypoints.positions.push_back(surface.point(std::size_t(i)));
  return keypoints;
}

}  // namespace sks
