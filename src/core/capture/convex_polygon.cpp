// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/convex_polygon.hpp"

#include <algorithm>
#include <limits>

namespace sks {
namespace {

float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool before(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

/// Andrew's monotone chain: the hull of sorted points on the right of the way from the first to the last.
template <typename Iterator>
void appendChain(Iterator begin, Iterator end, std::vector<Eigen::Vector2f>& hull) {
  const std::size_t start = hull.size();
  for (Iterator p = begin; p != end; ++p) {
    while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0) {
      hull.pop_back();
    }
    hull.push_back(*p);
  }
  if (!hull.empty()) hull.pop_back();  // it is the first of the other chain
}

}  // namespace

ConvexPolygon::ConvexPolygon(std::vector<Eigen::Vector2f> points) {
  std::sort(points.begin(), points.end(), before);
  appendChain(points.begin(), points.end(), corners_);
  appendChain(points.rbegin(), points.rend(), corners_);
}

float ConvexPolygon::depth(const Eigen::Vector2f& point) const {
  if (corners_.size() < 3) return -std::numeric_limits<float>::infinity();
  float depth = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2f edge = corners_[(i + 1) % corners_.size()] - corners_[i];
    depth = std::min(depth, cross(edge, point - corners_[i]) / edge.norm());
  }
  return depth;
}

float ConvexPolygon::area() const {
  float twice = 0;
  for (std::size_t i = 0; i < corners_.size(); ++i) twice += cross(corners_[i], corners_[(i + 1) % corners_.size()]);
  return 0.5f * twice;
}

}  // namespace sks
