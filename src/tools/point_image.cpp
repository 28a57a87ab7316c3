// SPDX-License-Identifier: BSD-3-Clause
#include "tools/point_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace sks::tools {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();
const cv::Vec3b background(40, 34, 30);

/// Depth [m] and index of the nearest point at each pixel.
struct Buffer {
  cv::Mat1f depth;
  cv::Mat1i index;
};

/// A point of the cloud in the picture.
struct Projection {
  cv::Point2d pixel;
  float depth;
  int index;
};

std::vector<Projection> project(const Cloud& cloud, const ViewCamera& camera, cv::Size size) {
  std::vector<Projection> projections;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    const Eigen::Vector3d p = camera.toCamera(cloud.points[i].cast<double>());
    if (p.z() < near_plane) continue;
    const cv::Point2d pixel = camera.pixel(p);
    const bool inside = pixel.x >= 0 && pixel.x < size.width && pixel.y >= 0 && pixel.y < size.height;
    if (inside) projections.push_back({pixel, float(p.z()), int(i)});
  }
  return projections;
}

/// Edge of the squares that just cover a surface if each point is drawn as one.
int squareSize(const std::vector<Projection>& projections, cv::Size size) {
  constexpr int cell = 16, smallest = 1, largest = 12;
  cv::Mat1b covered = cv::Mat1b::zeros(size.height / cell + 1, size.width / cell + 1);
  for (const Projection& p : projections) covered(int(p.pixel.y) / cell, int(p.pixel.x) / cell) = 1;
  const double area = double(cv::countNonZero(covered)) * cell * cell;
  const double spacing = std::sqrt(area / double(std::max<std::size_t>(projections.size(), 1)));
  return std::clamp(int(std::ceil(1.5 * spacing)), smallest, largest);
}

Buffer splat(const std::vector<Projection>& projections, cv::Size size) {
  Buffer buffer{cv::Mat1f(size, nothing), cv::Mat1i(size, -1)};
  const int side = squareSize(projections, size);
  const cv::Rect frame({0, 0}, size);
  for (const Projection& p : projections) {
    const cv::Point corner(int(std::lround(p.pixel.x - 0.5 * side)), int(std::lround(p.pixel.y - 0.5 * side)));
    const cv::Rect inside = cv::Rect(corner, cv::Size(side, side)) & frame;
    for (int row = inside.y; row < inside.y + inside.height; ++row) {
      for (int column = inside.x; column < inside.x + inside.width; ++column) {
        if (p.depth >= buffer.depth(row, column)) continue;
        buffer.depth(row, column) = p.depth;
        buffer.index(row, column) = p.index;
      }
    }
  }
  return buffer;
}

/// Gives a pixel without a point, but with points all around it, the nearest of them.
void closeGaps(Buffer& buffer) {
  const Buffer before{buffer.depth.clone(), buffer.index.clone()};
  for (int row = 1; row + 1 < before.depth.rows; ++row) {
    for (int column = 1; column + 1 < before.depth.cols; ++column) {
      if (before.index(row, column) >= 0) continue;
      int filled = 0;
      for (int k = 0; k < 9; ++k) {
        const int r = row + k / 3 - 1, c = column + k % 3 - 1;
        if (before.index(r, c) < 0) continue;
        ++filled;
        if (before.depth(r, c) >= buffer.depth(row, column)) continue;
        buffer.depth(row, column) = before.depth(r, c);
        buffer.index(row, column) = before.index(r, c);
      }
      if (filled < 5) {
        buffer.depth(row, column) = nothing;
        buffer.index(row, column) = -1;
      }
    }
  }
}

/// Cosine of the angle between the line of sight and the surface's normal, from the depths around a pixel.
float inclination(const cv::Mat1f& depth, const ViewCamera& camera, int row, int column) {
  const auto at = [&](int r, int c) -> Eigen::Vector3d { return depth(r, c) * camera.ray(c, r); };
  const int reach = 3;
  const int left = std::max(column - reach, 0), right = std::min(column + reach, depth.cols - 1);
  const int top = std::max(row - reach, 0), bottom = std::min(row + reach, depth.rows - 1);
  const float here = depth(row, column);
  const auto usable = [&](int r, int c) { return std::abs(depth(r, c) - here) < 0.05f * here; };
  const Eigen::Vector3d across =
      at(row, usable(row, right) ? right : column) - at(row, usable(row, left) ? left : column);
  const Eigen::Vector3d down =
      at(usable(bottom, column) ? bottom : row, column) - at(usable(top, column) ? top : row, column);
  const Eigen::Vector3d normal = across.cross(down);
  const double length = normal.norm();
  return length > 0 ? float(std::abs(normal.dot(camera.ray(column, row).normalized())) / length) : 0.5f;
}

/// Near is warm, far is cool; surfaces seen at a slant are darker.
cv::Vec3b shade(float share_of_depth, float cosine) {
  const float light = 0.25f + 0.75f * cosine;
  const cv::Vec3f near(190, 215, 235), far(200, 150, 120);  // BGR
  const cv::Vec3f color = light * ((1 - share_of_depth) * near + share_of_depth * far);
  return {cv::saturate_cast<uchar>(color[0]), cv::saturate_cast<uchar>(color[1]), cv::saturate_cast<uchar>(color[2])};
}

}  // namespace

cv::Mat renderPoints(const Cloud& cloud, const ViewCamera& camera, cv::Size size) {
  Buffer buffer = splat(project(cloud, camera, size), size);
  for (int pass = 0; pass < 3; ++pass) closeGaps(buffer);  // three close a crossing of lines one pixel wide

  std::vector<float> depths;
  for (const float depth : buffer.depth) {
    if (depth < nothing) depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  const float near = depths.empty() ? 0 : depths[depths.size() / 50],
              far = depths.empty() ? 1 : depths[depths.size() - 1 - depths.size() / 50];
  cv::Mat1f smooth;
  cv::medianBlur(buffer.depth, smooth, 5);

  cv::Mat3b image(size, background);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const int index = buffer.index(row, column);
      if (index < 0) continue;
      if (cloud.hasColor()) {
        const Rgb& rgb = cloud.colors[std::size_t(index)];
        image(row, column) = {rgb.b, rgb.g, rgb.r};
      } else {
        const float share = std::clamp((buffer.depth(row, column) - near) / std::max(far - near, 1e-6f), 0.0f, 1.0f);
        const bool known = smooth(row, column) < nothing;
        image(row, column) = shade(share, known ? inclination(smooth, camera, row, column) : 0.5f);
      }
    }
  }
  return image;
}

}  // namespace sks::tools
