// SPDX-License-Identifier: BSD-3-Clause
#include "tools/meshing/greedy_triangles.hpp"

#include <cstddef>

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/surface/impl/gp3.hpp>

namespace sks::tools {
namespace {

// PCL's names: edges are at most `reach` spacings long, and `mu` times the distance of the nearest point.
constexpr double reach = 5, mu = 3;
constexpr int most_neighbors = 100;
constexpr double degree = 0.017453292519943295;

}  // namespace

std::vector<Eigen::Vector3i> greedyTriangles(const std::vector<Eigen::Vector3f>& points,
                                             const std::vector<Eigen::Vector3f>& normals, double spacing) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = points[i];
    point.getNormalVector3fMap() = normals[i];
    cloud->push_back(point);
  }
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> projection;
  projection.setSearchRadius(reach * spacing);
  projection.setMu(mu);
  projection.setMaximumNearestNeighbors(most_neighbors);
  projection.setMaximumSurfaceAngle(60 * degree);
  projection.setMinimumAngle(10 * degree);
  projection.setMaximumAngle(120 * degree);
  projection.setNormalConsistency(true);
  projection.setInputCloud(cloud);
  projection.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);  // its warnings are of its own parameters
  std::vector<pcl::Vertices> polygons;
  projection.reconstruct(polygons);

  std::vector<Eigen::Vector3i> triangles;
  for (const pcl::Vertices& polygon : polygons) {
    if (polygon.vertices.size() != 3) continue;
    Eigen::Vector3i triangle(int(polygon.vertices[0]), int(polygon.vertices[1]), int(polygon.vertices[2]));
    const auto corner = [&](int k) { return points[std::size_t(triangle[k])]; };
    const Eigen::Vector3f across = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    if (across.dot(normals[std::size_t(triangle[0])]) < 0) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace sks::tools
