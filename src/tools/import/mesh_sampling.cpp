// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <Eigen/Geometry>

#include <sks_detector/error.hpp>

#include "tools/import/off_mesh.hpp"

namespace sks::tools {

Cloud sampleMesh(const OffMesh& mesh, int points, double diagonal) {
  std::vector<double> area_before{0};  // of each triangle, those before it together
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[t[1]].cast<double>(), c = mesh.vertices[t[2]].cast<double>();
    area_before.push_back(area_before.back() + 0.5 * (b - a).cross(c - a).norm());
  }
  const double area = area_before.back();
  if (!(area > 0)) throw Error(ErrorCode::bad_data, "the mesh has no area");

  // Equal steps of area choose the triangle, two numbers of the R2 sequence (Roberts 2018) the place in it: both spread
  // more evenly than random numbers do, and normals need even points.
  constexpr double r1 = 0.7548776662466927, r2 = 0.5698402909980532;
  Cloud cloud;
  Eigen::AlignedBox3f box;
  std::size_t triangle = 0;
  for (int i = 0; i < points; ++i) {
    const double target = area * (i + 0.5) / points;
    while (triangle + 1 < mesh.triangles.size() && area_before[triangle + 1] <= target) ++triangle;
    double whole = 0;
    const double root = std::sqrt(std::modf(0.5 + r1 * i, &whole)), v = std::modf(0.5 + r2 * i, &whole);
    const auto& t = mesh.triangles[triangle];
    const Eigen::Vector3f p = float(1 - root) * mesh.vertices[t[0]] + float(root * (1 - v)) * mesh.vertices[t[1]] +
                              float(root * v) * mesh.vertices[t[2]];
    cloud.points.push_back(p);
    box.extend(p);
  }
  const Eigen::Vector3f center = box.center();
  const float scale = float(diagonal) / box.diagonal().norm();
  for (Eigen::Vector3f& p : cloud.points) p = scale * (p - center);
  cloud.width = std::uint32_t(cloud.size());
  return cloud;
}

}  // namespace sks::tools
