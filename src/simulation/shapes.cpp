// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/surface/even_directions.hpp"

namespace sks {
namespace {

using Quad = std::function<Eigen::Vector3f(int, int)>;

/// Adds a sheet of rows * columns squares whose corners are at position(row, column).
void addSheet(Mesh& mesh, int rows, int columns, const Paint& paint, const Quad& position) {
  const int first = int(mesh.vertices.size());
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      mesh.vertices.push_back(position(row, column));
      mesh.colors.push_back(paint(mesh.vertices.back()));
    }
  }
  const auto corner = [&](int row, int column) { return first + row * (columns + 1) + column; };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int a = corner(row, column), b = corner(row, column + 1), c = corner(row + 1, column + 1),
                d = corner(row + 1, column);
      mesh.triangles.emplace_back(a, b, c);
      mesh.triangles.emplace_back(a, c, d);
    }
  }
}

/// Cuts each triangle of a unit sphere in four.
void subdivide(Mesh& sphere) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), int(sphere.vertices.size()));
    if (fresh) {
      sphere.vertices.push_back((sphere.vertices[std::size_t(a)] + sphere.vertices[std::size_t(b)]).normalized());
    }
    return found->second;
  };
  std::vector<Eigen::Vector3i> triangles;
  for (const Eigen::Vector3i& t : sphere.triangles) {
    const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    triangles.insert(triangles.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
  }
  sphere.triangles = std::move(triangles);
}

/// Unit sphere, without colours.
Mesh icosphere(int subdivisions) {
  const float g = (1 + std::sqrt(5.0f)) / 2;
  Mesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Eigen::Vector3f& v : mesh.vertices) v.normalize();
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int i = 0; i < subdivisions; ++i) subdivide(mesh);
  return mesh;
}

}  // namespace

Paint plain(const Rgb& color) {
  return [color](const Eigen::Vector3f&) { return color; };
}

Mesh makeBox(const Eigen::Vector3f& size, const Paint& paint, float cell) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const int rows = std::max(1, int(std::lround(size[a] / cell))),
              columns = std::max(1, int(std::lround(size[b] / cell)));
    for (const float side : {-0.5f, 0.5f}) {
      addSheet(mesh, rows, columns, paint, [&](int row, int column) {
        Eigen::Vector3f p;
        p[axis] = side * size[axis];
        p[a] = size[a] * (float(row) / float(rows) - 0.5f);
        p[b] = 2 * side * size[b] * (float(column) / float(columns) - 0.5f);
        return p;
      });
    }
  }
  return mesh;
}

Mesh makeSphere(float radius, int subdivisions, const Paint& paint) {
  Mesh mesh = icosphere(subdivisions);
  for (Eigen::Vector3f& v : mesh.vertices) {
    v *= radius;
    mesh.colors.push_back(paint(v));
  }
  return mesh;
}

Mesh makeRevolution(const std::vector<Eigen::Vector2f>& profile, int segments, const Paint& paint) {
  Mesh mesh;
  addSheet(mesh, int(profile.size()) - 1, segments, paint, [&](int row, int column) {
    const Eigen::Vector2f& p = profile[std::size_t(row)];
    const float angle = 2 * float(EIGEN_PI) * float(column % segments) / float(segments);
    return Eigen::Vector3f(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
  });
  return mesh;
}

Mesh makeTube(const std::vector<Eigen::Vector3f>& path, const std::vector<float>& radius, int segments,
              const Paint& paint) {
  std::vector<Eigen::Vector3f> across;  // carried along the path, so that the tube does not twist
  Eigen::Vector3f side = Eigen::Vector3f::UnitZ();
  const auto direction = [&](std::size_t i) -> Eigen::Vector3f {
    return (path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]).normalized();
  };
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector3f along = direction(i);
    if (std::abs(side.dot(along)) > 0.95f) side = along.unitOrthogonal();
    side = (side - side.dot(along) * along).normalized();
    across.push_back(side);
  }
  Mesh mesh;
  const int rings = int(path.size());  // and a point at each end
  addSheet(mesh, rings + 1, segments, paint, [&](int row, int column) -> Eigen::Vector3f {
    const auto i = std::size_t(std::clamp(row - 1, 0, rings - 1));
    if (row == 0 || row == rings + 1) return path[i];
    const float angle = 2 * float(EIGEN_PI) * float(column % segments) / float(segments);
    return path[i] + radius[i] * (std::cos(angle) * across[i] + std::sin(angle) * direction(i).cross(across[i]));
  });
  return mesh;
}

Mesh makeRod(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float from_radius, float to_radius,
             const Paint& paint, float step) {
  const std::vector<Eigen::Vector3f> path = subdivided<Eigen::Vector3f>({from, to}, step);
  std::vector<float> radius;
  for (std::size_t i = 0; i < path.size(); ++i) {
    radius.push_back(from_radius + (to_radius - from_radius) * float(i) / float(path.size() - 1));
  }
  return makeTube(path, radius, 40, paint);
}

template <typename Point>
std::vector<Point> subdivided(const std::vector<Point>& points, float step) {
  std::vector<Point> result{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point way = points[i] - points[i - 1];
    const int pieces = std::max(1, int(std::ceil(way.norm() / step)));
    for (int k = 1; k <= pieces; ++k) result.push_back(points[i - 1] + way * (float(k) / float(pieces)));
  }
  return result;
}
template std::vector<Eigen::Vector2f> subdivided(const std::vector<Eigen::Vector2f>&, float);
template std::vector<Eigen::Vector3f> subdivided(const std::vector<Eigen::Vector3f>&, float);

void append(Mesh& mesh, const Mesh& more) {
  const int first = int(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  mesh.colors.insert(mesh.colors.end(), more.colors.begin(), more.colors.end());
  for (const Eigen::Vector3i& t : more.triangles) mesh.triangles.emplace_back(t.array() + first);
}

Mesh transformed(Mesh mesh, const Eigen::Isometry3f& transform) {
  for (Eigen::Vector3f& v : mesh.vertices) v = transform * v;
  return mesh;
}

Mesh movedTo(Mesh mesh, float x, float y, float z) {
  return transformed(std::move(mesh), Eigen::Isometry3f(Eigen::Translation3f(x, y, z)));
}

std::vector<Eigen::Vector3d> geodesicDirections(int count) {
  std::vector<Eigen::Vector3d> directions;
  for (int subdivisions = 0; subdivisions < 5; ++subdivisions) {
    const Mesh sphere = icosphere(subdivisions);
    if (int(sphere.vertices.size()) != count) continue;
    for (const Eigen::Vector3f& v : sphere.vertices) directions.push_back(v.cast<double>().normalized());
    return directions;
  }
  return evenDirections(count);
}

}  // namespace sks
