// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/object_model.hpp"

#include <algorithm>
#include <cmath>

namespace sks {
namespace {

constexpr double largest_turn_step = 0.01;  // way of the farthest point, in diameters
constexpr int diameter_directions = 1000;

Eigen::Isometry3d turnAbout(const ObjectSymmetries::Axis& axis, double angle) {
  return Eigen::Translation3d(axis.position) * Eigen::AngleAxisd(angle, axis.direction) *
         Eigen::Translation3d(-axis.position);
}

/// Evenly spread over a half sphere: a spiral by the golden angle.
Eigen::Vector3d halfSphereDirection(int number) {
  const double z = (number + 0.5) / diameter_directions, angle = number * EIGEN_PI * (3 - std::sqrt(5.0));
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

std::vector<Eigen::Isometry3d> symmetryMotions(const ObjectSymmetries& symmetries) {
  std::vector<Eigen::Isometry3d> discrete{Eigen::Isometry3d::Identity()};
  discrete.insert(discrete.end(), symmetries.discrete.begin(), symmetries.discrete.end());
  if (symmetries.continuous.empty()) return discrete;
  // no point is farther from the axis than half a diameter
  const int steps = int(std::ceil(EIGEN_PI / largest_turn_step));
  std::vector<Eigen::Isometry3d> motions;
  for (const Eigen::Isometry3d& motion : discrete) {
    for (const ObjectSymmetries::Axis& axis : symmetries.continuous) {
      for (int i = 0; i < steps; ++i) motions.push_back(turnAbout(axis, i * 2 * EIGEN_PI / steps) * motion);
    }
  }
  return motions;
}

ObjectSymmetries listedSymmetries(const Symmetry& symmetry, const Eigen::Vector3d& center) {
  const ObjectSymmetries::Axis axis{symmetry.axis, center};
  ObjectSymmetries result;
  if (symmetry.order == 0) result.continuous.push_back(axis);
  for (int i = 1; i < symmetry.order; ++i) {
    result.discrete.push_back(turnAbout(axis, i * 2 * EIGEN_PI / symmetry.order));
  }
  return result;
}

double diameterOf(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return 0;
  std::vector<std::size_t> extremes;
  for (int i = 0; i < diameter_directions; ++i) {
    const Eigen::Vector3d direction = halfSphereDirection(i);
    std::size_t low = 0, high = 0;
    double lowest = direction.dot(points[0]), highest = lowest;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double along = direction.dot(points[k]);
      if (along < lowest) {
        lowest = along;
        low = k;
      } else if (along > highest) {
        highest = along;
        high = k;
      }
    }
    extremes.push_back(low);
    extremes.push_back(high);
  }
  std::sort(extremes.begin(), extremes.end());
  extremes.erase(std::unique(extremes.begin(), extremes.end()), extremes.end());
  double diameter = 0;
  for (std::size_t i = 0; i < extremes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      diameter = std::max(diameter, (points[extremes[i]] - points[extremes[k]]).norm());
    }
  }
  return diameter;
}

}  // namespace sks
