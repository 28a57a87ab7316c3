// SPDX-License-Identifier: BSD-3-Clause
#include "core/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

constexpr int bits_per_axis = 21;
constexpr double half_range = double(1 << (bits_per_axis - 1));

std::uint64_t cellKey(const Eigen::Vector3f& point, double inverse_edge) {
  std::uint64_t key = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double cell = std::floor(point[axis] * inverse_edge) + half_range;
    if (!(cell >= 0 && cell < 2 * half_range)) {
      throw Error(ErrorCode::bad_data, "a coordinate of " + std::to_string(point[axis]) +
                                           " m is too far from the origin for a grid of " +
                                           std::to_string(1.0 / inverse_edge) + " m");
    }
    key = key << bits_per_axis | std::uint64_t(cell);
  }
  return key;
}

}  // namespace

VoxelGroups groupByVoxel(const std::vector<Eigen::Vector3f>& points, double edge) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) entries[i] = {cellKey(points[i], 1.0 / edge), std::uint32_t(i)};
  std::sort(entries.begin(), entries.end());

  VoxelGroups groups;
  groups.points.reserve(points.size());
  for (std::size_t begin = 0, end; begin < entries.size(); begin = end) {
    groups.begin.push_back(std::uint32_t(begin));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (end = begin; end < entries.size() && entries[end].first == entries[begin].first; ++end) {
      groups.points.push_back(entries[end].second);
      sum += points[entries[end].second].cast<double>();
    }
    groups.centroids.push_back((sum / double(end - begin)).cast<float>());
  }
  groups.begin.push_back(std::uint32_t(points.size()));
  return groups;
}

}  // namespace sks
