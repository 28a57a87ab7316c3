// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as PCL takes them, to compare with its implementations.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <sks_detector/stages/surface.hpp>

namespace sks::test {

inline pcl::PointCloud<pcl::PointXYZ>::Ptr pclPoints(const std::vector<Eigen::Vector3f>& points) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const auto& p : points) cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

inline pcl::PointCloud<pcl::Normal>::Ptr pclNormals(const Surface& surface) {
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    normals->push_back({surface.nx[i], surface.ny[i], surface.nz[i]});
  }
  return normals;
}

}  // namespace sks::test
