// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/convex_parts.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <LinearMath/btConvexHullComputer.h>
#include <Eigen/Eigenvalues>

namespace sks {
namespace {

constexpr std::size_t most_parts = 64, fewest_triangles = 8;

struct Hull {
  std::vector<Eigen::Vector3f> corners;
  std::vector<Eigen::Hyperplane<float, 3>> faces;  // normals outwards
};

Hull hullOf(const std::vector<Eigen::Vector3f>& points) {
  Hull hull;
  if (points.size() < 4) return hull;
  std::vector<float> numbers;
  for (const Eigen::Vector3f& p : points) numbers.insert(numbers.end(), p.data(), p.data() + 3);
  btConvexHullComputer computer;
  computer.compute(numbers.data(), 3 * sizeof(float), int(points.size()), 0, 0);
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (int i = 0; i < computer.vertices.size(); ++i) {
    const btVector3& v = computer.vertices[i];
    hull.corners.emplace_back(float(v.x()), float(v.y()), float(v.z()));
    middle += hull.corners.back();
  }
  middle /= float(std::max<std::size_t>(hull.corners.size(), 1));
  for (int i = 0; i < computer.faces.size(); ++i) {
    const btConvexHullComputer::Edge* edge = &computer.edges[computer.faces[i]];
    const auto corner = [&] { return hull.corners[std::size_t(edge->getSourceVertex())]; };
    const Eigen::Vector3f a = corner();
    edge = edge->getNextEdgeOfFace();
    const Eigen::Vector3f b = corner();
    edge = edge->getNextEdgeOfFace();
    const Eigen::Vector3f normal = (b - a).cross(corner() - a).normalized();
    if (!normal.allFinite()) continue;
    hull.faces.emplace_back(normal.dot(middle - a) > 0 ? -normal : normal, a);
  }
  return hull;
}

using Triangles = std::vector<std::size_t>;

Eigen::Vector3f middleOf(const Mesh& mesh, std::size_t triangle) {
  return mesh.point(triangle, 1.0f / 3, 1.0f / 3);
}

/// The corners of the triangles, one for each cube of an edge.
std::vector<Eigen::Vector3f> pointsOf(const Mesh& mesh, const Triangles& part, float edge) {
  std::set<std::tuple<int, int, int>> cubes;
  std::vector<Eigen::Vector3f> points;
  for (const std::size_t t : part) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f& p = mesh.vertices[std::size_t(mesh.triangles[t][k])];
      const auto cube = [&](int axis) { return int(std::floor(p[axis] / edge)); };
      if (cubes.emplace(cube(0), cube(1), cube(2)).second) points.push_back(p);
    }
  }
  return points;
}

/// How deep the surface lies inside of its hull at most.
float depthInside(const Mesh& mesh, const Triangles& part, const Hull& hull) {
  float deepest = 0;
  const std::size_t stride = std::max<std::size_t>(1, part.size() / 400);
  for (std::size_t i = 0; i < part.size(); i += stride) {
    const Eigen::Vector3f p = middleOf(mesh, part[i]);
    float depth = 1e9f;
    for (const auto& face : hull.faces) depth = std::min(depth, -face.signedDistance(p));
    deepest = std::max(deepest, depth);
  }
  return hull.faces.empty() ? 0 : deepest;
}

/// Cuts across the longest extent.
std::pair<Triangles, Triangles> halves(const Mesh& mesh, const Triangles& part) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const std::size_t t : part) mean += middleOf(mesh, t);
  mean /= float(part.size());
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const std::size_t t : part) spread += (middleOf(mesh, t) - mean) * (middleOf(mesh, t) - mean).transpose();
  const Eigen::Vector3f longest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(spread).eigenvectors().col(2);
  std::pair<Triangles, Triangles> result;
  for (const std::size_t t : part) {
    (longest.dot(middleOf(mesh, t) - mean) < 0 ? result.first : result.second).push_back(t);
  }
  return result;
}

}  // namespace

std::vector<std::vector<Eigen::Vector3f>> convexParts(const Mesh& mesh, float tolerance) {
  std::vector<Triangles> open(1), closed;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) open[0].push_back(t);
  while (!open.empty()) {
    const Triangles part = std::move(open.front());
    open.erase(open.begin());
    const bool whole = part.size() < fewest_triangles || open.size() + closed.size() + 2 > most_parts ||
                       depthInside(mesh, part, hullOf(pointsOf(mesh, part, tolerance))) <= tolerance;
    const auto [first, second] = whole ? std::pair<Triangles, Triangles>() : halves(mesh, part);
    if (first.empty() || second.empty()) {
      closed.push_back(part);
    } else {
      open.push_back(first);
      open.push_back(second);
    }
  }
  std::vector<std::vector<Eigen::Vector3f>> parts;
  parts.reserve(closed.size());
  for (const Triangles& part : closed) parts.push_back(pointsOf(mesh, part, 0.5f * tolerance));
  return parts;
}

std::vector<Eigen::Vector3f> hullCorners(const std::vector<Eigen::Vector3f>& points) {
  return hullOf(points).corners;
}

}  // namespace sks
