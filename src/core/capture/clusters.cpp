// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/clusters.hpp"

#include <algorithm>

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

namespace sks {

std::vector<Eigen::Vector3f> at(const std::vector<Eigen::Vector3f>& points, const Indices& indices) {
  std::vector<Eigen::Vector3f> chosen;
  chosen.reserve(indices.size());
  for (const std::uint32_t i : indices) chosen.push_back(points[i]);
  return chosen;
}

std::vector<Indices> findClusters(const std::vector<Eigen::Vector3f>& points, double gap) {
  if (points.empty()) return {};
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3f& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(gap);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  std::vector<Indices> clusters;
  clusters.reserve(found.size());
  for (const pcl::PointIndices& cluster : found) clusters.emplace_back(cluster.indices.begin(), cluster.indices.end());
  const auto larger = [](const Indices& a, const Indices& b) { return a.size() > b.size(); };
  std::stable_sort(clusters.begin(), clusters.end(), larger);
  return clusters;
}

}  // namespace sks
