// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera/organized_cloud.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace sks_detector {
namespace {

/// For each of `count` positions along an edge the nearest of `target_count`, in proportion.
std::vector<int> proportional(int count, int target_count) {
  std::vector<int> result(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    result[std::size_t(i)] = int((2 * std::int64_t(i) + 1) * target_count / (2 * std::int64_t(count)));
  }
  return result;
}

/// (pixel - centre) / focal length for each pixel along an edge.
std::vector<float> slopes(int count, double center, double focal_length) {
  std::vector<float> result(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) result[std::size_t(i)] = float((i - center) / focal_length);
  return result;
}

void backProject(const DepthImage& depth, const Intrinsics& intrinsics, OrganizedPoint* points) {
  const std::vector<float> slope_x = slopes(depth.width, intrinsics.cx, intrinsics.fx);
  const std::vector<float> slope_y = slopes(depth.height, intrinsics.cy, intrinsics.fy);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::size_t i = 0;
  for (const float row : slope_y) {
    for (const float column : slope_x) {
      const float z = depth.pixels[i] == 0 ? nan : 0.001F * float(depth.pixels[i]);
      points[i++] = {column * z, row * z, z, 0};
    }
  }
}

void paint(const ColorImage& color, int width, int height, OrganizedPoint* points) {
  const std::vector<int> columns = proportional(width, color.width);
  const std::vector<int> rows = proportional(height, color.height);
  std::size_t i = 0;
  for (const int row : rows) {
    const std::uint8_t* line = color.pixels.data() + std::size_t(row) * std::size_t(color.width) * 3;
    for (const int column : columns) {
      const std::uint8_t* pixel = line + std::size_t(column) * 3;
      points[i++].rgb = std::uint32_t(pixel[0]) << 16 | std::uint32_t(pixel[1]) << 8 | pixel[2];
    }
  }
}

}  // namespace

void organizedCloud(const CameraFrame& frame, OrganizedPoint* points) {
  backProject(frame.depth, frame.intrinsics, points);
  if (!frame.color.pixels.empty()) paint(frame.color, frame.depth.width, frame.depth.height, points);
}

}  // namespace sks_detector
