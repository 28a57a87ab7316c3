// SPDX-License-Identifier: BSD-3-Clause
#include "core/surface/voxels.hpp"

#include <algorithm>
#include <string>

#include <Eigen/Geometry>

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

void sortInHalves(std::vector<Segment>& segments, int threads) {
  const auto middle = segments.begin() + std::ptrdiff_t(segments.size() / 2);
#pragma omp parallel sections num_threads(threads)
  {
#pragma omp section
    std::sort(segments.begin(), middle);
#pragma omp section
    std::sort(middle, segments.end());
  }
  std::inplace_merge(segments.begin(), middle, segments.end());
}

template <typename PointAt>
std::vector<Segment> sortedSegments(std::size_t count, double edge, PointAt&& point, int threads) {
  std::vector<std::uint64_t> keys(count);
  const auto check = [&](const Eigen::Vector3f& corner) { cellKey(corner, 1.0 / edge); };  // no error may leave threads
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < count; ++i) box.extend(point(i));
  if (count > 0) {
    check(box.min());
    check(box.max());
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) keys[i] = cellKey(point(i), 1.0 / edge);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < count; ++i) {
    if (segments.empty() || segments.back().key != keys[i]) segments.push_back({keys[i], std::uint32_t(i), 0});
    segments.back().end = std::uint32_t(i + 1);
  }
  sortInHalves(segments, threads);
  return segments;
}

/// The first segment of each cube, and one past the last of all.
std::vector<std::size_t> cubesOf(const std::vector<Segment>& segments) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i == 0 || segments[i].key != segments[i - 1].key) first.push_back(i);
  }
  first.push_back(segments.size());
  return first;
}

template <typename PointAt>
std::vector<Eigen::Vector3f> centroidsOf(const std::vector<Segment>& segments, const std::vector<std::size_t>& first,
                                         PointAt&& point, int threads) {
  std::vector<Eigen::Vector3f> centroids(first.size() - 1);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t cube = 0; cube < centroids.size(); ++cube) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (std::size_t s = first[cube]; s < first[cube + 1]; ++s) {
      for (std::uint32_t i = segments[s].begin; i < segments[s].end; ++i) sum += point(i).template cast<double>();
      count += segments[s].end - segments[s].begin;
    }
    centroids[cube] = (sum / double(count)).cast<float>();
  }
  return centroids;
}

}  // namespace

VoxelGroups groupByVoxel(const std::vector<Eigen::Vector3f>& points, double edge, int threads) {
  const auto point = [&](std::size_t i) -> const Eigen::Vector3f& { return points[i]; };
  const auto segments = sortedSegments(points.size(), edge, point, threads);
  const auto first = cubesOf(segments);
  VoxelGroups groups;
  groups.centroids = centroidsOf(segments, first, point, threads);
  groups.points.reserve(points.size());
  for (std::size_t cube = 0; cube + 1 < first.size(); ++cube) {
    groups.begin.push_back(std::uint32_t(groups.points.size()));
    for (std::size_t s = first[cube]; s < first[cube + 1]; ++s) {
      for (std::uint32_t i = segments[s].begin; i < segments[s].end; ++i) groups.points.push_back(i);
    }
  }
  groups.begin.push_back(std::uint32_t(points.size()));
  return groups;
}

std::vector<Eigen::Vector3f> voxelCentroids(const PointGrid& points, double edge, int threads) {
  const auto point = [&](std::size_t i) { return points.point(i); };
  const auto segments = sortedSegments(points.size(), edge, point, threads);
  return centroidsOf(segments, cubesOf(segments), point, threads);
}

}  // namespace sks
