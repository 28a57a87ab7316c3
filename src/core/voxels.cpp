// SPDX-License-Identifier: BSD-3-Clause
#include "core/voxels.hpp"

#include <algorithm>
#include <string>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

constexpr int bits_per_axis = 21;
constexpr double half_range = double(1 << (bits_per_axis - 1));

/// Index of the cube of a coordinate, from 0.
std::uint64_t cellOf(float coordinate, double inverse_edge) {
  const double cell = double(coordinate) * inverse_edge + half_range;
  if (!(cell >= 0 && cell < 2 * half_range)) {
    throw Error(ErrorCode::bad_data, "a coordinate of " + std::to_string(coordinate) +
                                         " m is too far from the origin for a grid of " +
                                         std::to_string(1.0 / inverse_edge) + " m");
  }
  return std::uint64_t(std::int64_t(cell));  // one instruction, unlike the unsigned conversion
}

std::uint64_t cellKey(const Eigen::Vector3f& point, double inverse_edge) {
  return cellOf(point.z(), inverse_edge) << 2 * bits_per_axis | cellOf(point.y(), inverse_edge) << bits_per_axis |
         cellOf(point.x(), inverse_edge);
}

/// Consecutive points in one cube: where points have any order in space there are far fewer of these than of points.
struct Segment {
  std::uint64_t key;
  std::uint32_t begin, end;

  bool operator<(const Segment& other) const { return key < other.key || (key == other.key && begin < other.begin); }
};

template <typename PointAt>
std::vector<Segment> sortedSegments(std::size_t count, double edge, PointAt&& point) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t key = cellKey(point(i), 1.0 / edge);
    if (segments.empty() || segments.back().key != key) segments.push_back({key, std::uint32_t(i), 0});
    segments.back().end = std::uint32_t(i + 1);
  }
  std::sort(segments.begin(), segments.end());
  return segments;
}

/// Calls `cube(first segment, one past the last, centroid)` for each cube in order.
template <typename PointAt, typename Cube>
void forEachCube(const std::vector<Segment>& segments, PointAt&& point, Cube&& cube) {
  for (auto first = segments.begin(), last = first; first != segments.end(); first = last) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (; last != segments.end() && last->key == first->key; ++last) {
      for (std::uint32_t i = last->begin; i < last->end; ++i) sum += point(i).template cast<double>();
      count += last->end - last->begin;
    }
    cube(first, last, (sum / double(count)).template cast<float>());
  }
}

}  // namespace

VoxelGroups groupByVoxel(const std::vector<Eigen::Vector3f>& points, double edge) {
  const auto point = [&](std::size_t i) -> const Eigen::Vector3f& { return points[i]; };
  const auto segments = sortedSegments(points.size(), edge, point);
  VoxelGroups groups;
  groups.points.reserve(points.size());
  forEachCube(segments, point, [&](auto first, auto last, const Eigen::Vector3f& centroid) {
    groups.begin.push_back(std::uint32_t(groups.points.size()));
    groups.centroids.push_back(centroid);
    for (; first != last; ++first) {
      for (std::uint32_t i = first->begin; i < first->end; ++i) groups.points.push_back(i);
    }
  });
  groups.begin.push_back(std::uint32_t(points.size()));
  return groups;
}

std::vector<Eigen::Vector3f> voxelCentroids(const PointGrid& points, double edge) {
  const auto point = [&](std::size_t i) { return points.point(i); };
  std::vector<Eigen::Vector3f> centroids;
  forEachCube(sortedSegments(points.size(), edge, point), point,
              [&](auto, auto, const Eigen::Vector3f& centroid) { centroids.push_back(centroid); });
  return centroids;
}

}  // namespace sks
