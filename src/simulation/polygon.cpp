// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sks {
namespace {

constexpr std::size_t most_corners_with_dents = 256;  // the time grows with their square

/// The polygon in its plane, so that its corners go round to the left.
std::vector<Eigen::Vector2d> flattened(const std::vector<Eigen::Vector3f>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Newell's
  const Eigen::Vector3d origin = corners[0].cast<double>();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d a = corners[i].cast<double>() - origin;
    const Eigen::Vector3d b = corners[(i + 1) % corners.size()].cast<double>() - origin;
    normal += a.cross(b);
  }
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3f& corner : corners) {
    const Eigen::Vector3d p = corner.cast<double>() - origin;
    flat.emplace_back(normal[axis] < 0 ? -p[u] : p[u], p[v]);
  }
  return flat;
}

/// Twice the area of a triangle; positive where it turns left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// An ear: a corner whose triangle with its neighbours holds no other corner.
bool isEar(const std::vector<Eigen::Vector2d>& flat, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t size = left.size();
  const std::uint32_t ia = left[(at + size - 1) % size], ib = left[at], ic = left[(at + 1) % size];
  const Eigen::Vector2d &a = flat[ia], &b = flat[ib], &c = flat[ic];
  if (turn(a, b, c) <= 0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::uint32_t i) {
    if (i == ia || i == ib || i == ic || flat[i] == a || flat[i] == b || flat[i] == c) return false;
    return turn(a, b, flat[i]) >= 0 && turn(b, c, flat[i]) >= 0 && turn(c, a, flat[i]) >= 0;
  });
}

bool hasDents(const std::vector<Eigen::Vector2d>& flat) {
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (turn(flat[i], flat[(i + 1) % flat.size()], flat[(i + 2) % flat.size()]) < 0) return true;
  }
  return false;
}

}  // namespace

std::vector<PolygonTriangle> triangulate(const std::vector<Eigen::Vector3f>& corners) {
  std::vector<PolygonTriangle> triangles;
  std::vector<std::uint32_t> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = std::uint32_t(i);
  if (corners.size() > 3 && corners.size() <= most_corners_with_dents) {
    const std::vector<Eigen::Vector2d> flat = flattened(corners);
    if (hasDents(flat)) {
      for (std::size_t at = 0, tried = 0; left.size() > 3 && tried < left.size();) {
        at %= left.size();
        if (!isEar(flat, left, at)) {
          ++at;
          ++tried;
          continue;
        }
        const std::size_t size = left.size();
        triangles.push_back({left[(at + size - 1) % size], left[at], left[(at + 1) % size]});
        left.erase(left.begin() + std::ptrdiff_t(at));
        tried = 0;
      }
    }
  }
  for (std::size_t i = 2; i < left.size(); ++i) triangles.push_back({left[0], left[i - 1], left[i]});
  return triangles;
}

}  // namespace sks
