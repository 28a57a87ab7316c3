// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/depth_rendering.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr double nearest_depth = 1e-3;  // of a vertex [m]

/// A vertex in the picture; 1 / z is linear there.
struct PictureVertex {
  double column = 0, row = 0, inverse_depth = 0;
};

/// Twice the signed area of the triangle of two vertices and a position.
double signedArea(const PictureVertex& a, const PictureVertex& b, double column, double row) {
  return (b.column - a.column) * (row - a.row) - (b.row - a.row) * (column - a.column);
}

void drawTriangle(const PictureVertex& a, const PictureVertex& b, const PictureVertex& c, const SceneCamera& camera,
                  DepthMap& depth) {
  const double area = signedArea(a, b, c.column, c.row);
  if (area == 0) return;
  const auto first = [](double x, double y, double z, int size) {
    return int(std::ceil(std::clamp(std::min({x, y, z}), 0.0, double(size))));
  };
  const auto last = [](double x, double y, double z, int size) {
    return int(std::floor(std::clamp(std::max({x, y, z}), -1.0, size - 1.0)));
  };
  const int last_row = last(a.row, b.row, c.row, camera.height);
  const int last_column = last(a.column, b.column, c.column, camera.width);
  const int first_column = first(a.column, b.column, c.column, camera.width);
  for (int row = first(a.row, b.row, c.row, camera.height); row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      // edges belong to both of their triangles: the nearer one wins, whatever the order
      const double u = signedArea(b, c, column, row) / area, v = signedArea(c, a, column, row) / area,
                   w = signedArea(a, b, column, row) / area;
      if (u < 0 || v < 0 || w < 0) continue;
      const auto z = float(1 / (u * a.inverse_depth + v * b.inverse_depth + w * c.inverse_depth));
      float& pixel = depth[std::size_t(row) * std::size_t(camera.width) + std::size_t(column)];
      if (pixel == 0 || z < pixel) pixel = z;
    }
  }
}

}  // namespace

DepthMap renderDepth(const ObjectModel& model, const Eigen::Isometry3d& T_camera_model, const SceneCamera& camera) {
  DepthMap depth(std::size_t(camera.width) * std::size_t(camera.height), 0.0f);
  std::vector<PictureVertex> vertices;
  vertices.reserve(model.points.size());
  for (const Eigen::Vector3d& point : model.points) {
    const Eigen::Vector3d p = T_camera_model * point;
    const double inverse = p.z() >= nearest_depth ? 1 / p.z() : 0;  // 0: left out
    vertices.push_back({camera.fx * p.x() * inverse + camera.cx, camera.fy * p.y() * inverse + camera.cy, inverse});
  }
  for (const Eigen::Vector3i& t : model.triangles) {
    const PictureVertex &a = vertices[std::size_t(t[0])], &b = vertices[std::size_t(t[1])],
                        &c = vertices[std::size_t(t[2])];
    if (a.inverse_depth > 0 && b.inverse_depth > 0 && c.inverse_depth > 0) drawTriangle(a, b, c, camera, depth);
  }
  return depth;
}

}  // namespace sks
