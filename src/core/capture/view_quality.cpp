// SPDX-License-Identifier: BSD-3-Clause
#include "core/capture/view_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <sks_detector/stages/point_grid.hpp>

#include "core/settings/number_format.hpp"
#include "core/surface/clusters.hpp"

namespace sks {
namespace {

constexpr std::size_t few_points = 500;
constexpr double normal_radius_per_spacing = 2.5;  // below it too few neighbours for a normal remain
constexpr std::int64_t border = 2;                 // pixels at which an object counts as cut off

std::string millimetres(double metres) {
  return formatted("%.1f mm", 1000 * metres);
}

/// Distance of a point to the nearest other one. @param reach where to begin to look [m], more than 0
float nearestDistance(const PointGrid& grid, std::uint32_t point, float reach, std::vector<PointGrid::Run>& runs) {
  float nearest = std::numeric_limits<float>::infinity();
  for (float radius = reach; nearest > radius * radius; radius *= 2) {
    grid.forEachNeighbor(grid.point(point), radius, runs, [&](std::uint32_t i, float squared) {
      if (i != point) nearest = std::min(nearest, squared);
    });
  }
  return std::sqrt(nearest);
}

double medianSpacing(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& extent) {
  const float reach = extent.norm() / std::sqrt(float(points.size()));
  if (points.size() < 2 || !(reach > 0)) return 0;
  const PointGrid grid(points, reach);
  std::vector<PointGrid::Run> runs;
  std::vector<float> distances;
  for (std::uint32_t i = 0; i < grid.size(); ++i) distances.push_back(nearestDistance(grid, i, reach, runs));
  const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

/// Whether the object reaches the border of the image, or of the part of it in which anything else was measured.
bool isCutOff(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  if (!cloud.organized()) return false;
  using Box = Eigen::AlignedBox<std::int64_t, 2>;
  const auto pixel = [&](std::size_t i) { return Box::VectorType(i % cloud.width, i / cloud.width); };
  const Box image(pixel(0), pixel(cloud.size() - 1));
  Box others, object;
  auto next = points.begin();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (next != points.end() && *next == i) {
      object.extend(pixel(i));
      ++next;
    } else if (cloud.points[i].allFinite()) {
      others.extend(pixel(i));
    }
  }
  const auto touches = [&](const Box& box) {
    return !box.isEmpty() && (((object.min() - box.min()).array().abs() < border).any() ||
                              ((object.max() - box.max()).array().abs() < border).any());
  };
  return touches(image) || touches(others);
}

}  // namespace

ViewQuality assessView(const Cloud& cloud, const std::vector<std::uint32_t>& points, const Settings& settings) {
  ViewQuality quality;
  quality.points = points.size();
  Eigen::AlignedBox3f box;
  for (const std::uint32_t i : points) box.extend(cloud.points[i]);
  quality.extent = box.sizes();
  quality.spacing = medianSpacing(at(cloud.points, points), box.sizes());

  const auto remark = [&](const std::string& text) { quality.remarks.push_back(text); };
  const double normal_radius = settings.surface.normal_radius, finest = normal_radius / normal_radius_per_spacing;
  if (quality.points < few_points) {
    remark("only " + std::to_string(quality.points) + " points: move the camera closer");
  }
  if (quality.spacing > finest) {
    remark("too far away: the points are " + millimetres(quality.spacing) + " apart, but surface.normal_radius (" +
           millimetres(normal_radius) + ") needs " + millimetres(finest) +
           ": move the camera closer, or raise that setting");
  }
  if (box.sizes().maxCoeff() < settings.descriptor.radius) {
    remark("smaller than descriptor.radius (" + millimetres(settings.descriptor.radius) +
           "): lower that setting for objects of this size");
  }
  if (isCutOff(cloud, points)) remark("cut off by the border of the image: move the object to the middle");
  if (!cloud.hasColor()) remark("without colour: codebooks with this view describe shape alone (SHOT)");
  const bool behind = cloud.sensor_origin.isZero() && box.center().z() <= 0;
  if (behind) remark("not in front of the camera (z > 0): is the cloud in the camera's frame? See ~sensor_frame");
  return quality;
}

}  // namespace sks
