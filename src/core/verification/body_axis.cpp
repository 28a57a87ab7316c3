// SPDX-License-Identifier: BSD-3-Clause
#include "core/verification/body_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

namespace sks {
namespace {

constexpr std::size_t most_lines = 600;  // normals that are looked at
constexpr int trials = 60;               // with half of the normals right, all fail once in 3e7
constexpr float lateral = 0.5f;          // of a normal's length lies across the axis: others tell little of it
constexpr float off = 0.17f;             // sine of the angle by which a normal may miss the axis: 10 degrees, its noise
constexpr double least_lateral = 0.6;    // of the lateral normals meet the axis; of a box's a fifth do
constexpr double least_area = 0.3;       // of the whole surface

/// A normal in the plane across the axis.
struct NormalLine {
  Eigen::Vector2f point, along;
};

float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool meets(const NormalLine& line, const Eigen::Vector2f& center) {
  const Eigen::Vector2f radius = line.point - center;
  return std::abs(cross(line.along, radius)) <= off * radius.norm();
}

std::size_t countMeeting(const std::vector<NormalLine>& lines, const Eigen::Vector2f& center) {
  return std::size_t(
      std::count_if(lines.begin(), lines.end(), [&](const NormalLine& line) { return meets(line, center); }));
}

/// Where the lines that meet a point meet best, by least squares.
Eigen::Vector2f settled(const std::vector<NormalLine>& lines, const Eigen::Vector2f& center) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const NormalLine& line : lines) {
    if (!meets(line, center)) continue;
    const Eigen::Vector2d across(-double(line.along.y()), double(line.along.x()));
    information += across * across.transpose();
    sum += across * across.dot(line.point.cast<double>());
  }
  return information.ldlt().solve(sum).cast<float>();
}

}  // namespace

std::optional<BodyAxis> findBodyAxis(const std::vector<Eigen::Vector3f>& points,
                                     const std::vector<Eigen::Vector3f>& normals) {
  std::optional<BodyAxis> best;
  std::size_t most = 0;
  const std::size_t stride = points.size() / most_lines + 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<NormalLine> lines;
    std::size_t looked_at = 0;
    for (std::size_t i = 0; i < points.size(); i += stride, ++looked_at) {
      const Eigen::Vector2f across(normals[i][u], normals[i][v]);
      if (across.norm() >= lateral) lines.push_back({{points[i][u], points[i][v]}, across.normalized()});
    }
    if (lines.size() < 10) continue;
    std::mt19937 random(1);
    Eigen::Vector2f center = Eigen::Vector2f::Zero();
    std::size_t meeting = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const NormalLine &a = lines[random() % lines.size()], &b = lines[random() % lines.size()];
      const float sine = cross(a.along, b.along);
      if (std::abs(sine) < lateral) continue;  // nearly parallel: where they meet is not known well
      const Eigen::Vector2f where = a.point + a.along * (cross(b.point - a.point, b.along) / sine);
      const std::size_t count = countMeeting(lines, where);
      if (count <= meeting) continue;
      meeting = count;
      center = where;
    }
    if (double(meeting) < least_lateral * double(lines.size()) || double(meeting) < least_area * double(looked_at) ||
        meeting <= most) {
      continue;
    }
    most = meeting;
    center = settled(lines, center);
    BodyAxis found;
    found.direction = axis;
    found.origin[u] = double(center.x());
    found.origin[v] = double(center.y());
    best = found;
  }
  return best;
}

}  // namespace sks
