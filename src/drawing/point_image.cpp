// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/point_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace sks {
namespace {

constexpr float no_depth = std::numeric_limits<float>::infinity();
constexpr Rgb background{30, 34, 40};

/// Depth [m] and index of the nearest point at each pixel.
struct Buffer {
  Image<float> depth;
  Image<int> index;
};

/// A point of the cloud in the picture.
struct Projection {
  Eigen::Vector2d pixel;
  float depth;
  int index;
};

std::vector<Projection> project(const Cloud& cloud, const ViewCamera& camera, PictureSize size) {
  std::vector<Projection> projections;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    const Eigen::Vector3d p = camera.toCamera(cloud.points[i].cast<double>());
    if (p.z() < near_plane) continue;
    const Eigen::Vector2d pixel = camera.pixel(p);
    const bool inside = pixel.x() >= 0 && pixel.x() < size.width && pixel.y() >= 0 && pixel.y() < size.height;
    if (inside) projections.push_back({pixel, float(p.z()), int(i)});
  }
  return projections;
}

/// Edge of the squares that just cover a surface if each point is drawn as one.
int squareSize(const std::vector<Projection>& projections, PictureSize size) {
  constexpr int cell = 16, smallest = 1, largest = 12;
  Image<char> covered(size.width / cell + 1, size.height / cell + 1, 0);
  for (const Projection& p : projections) covered(int(p.pixel.y()) / cell, int(p.pixel.x()) / cell) = 1;
  const double area = double(std::count(covered.pixels.begin(), covered.pixels.end(), 1)) * cell * cell;
  const double spacing = std::sqrt(area / double(std::max<std::size_t>(projections.size(), 1)));
  return std::clamp(int(std::ceil(1.5 * spacing)), smallest, largest);
}

Buffer splat(const std::vector<Projection>& projections, PictureSize size) {
  Buffer buffer{{size.width, size.height, no_depth}, {size.width, size.height, -1}};
  const int side = squareSize(projections, size);
  for (const Projection& p : projections) {
    const int left = int(std::lround(p.pixel.x() - 0.5 * side)), top = int(std::lround(p.pixel.y() - 0.5 * side));
    for (int row = std::max(top, 0); row < std::min(top + side, size.height); ++row) {
      for (int column = std::max(left, 0); column < std::min(left + side, size.width); ++column) {
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
  const Buffer before = buffer;
  for (int row = 1; row + 1 < before.depth.height; ++row) {
    for (int column = 1; column + 1 < before.depth.width; ++column) {
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
        buffer.depth(row, column) = no_depth;
        buffer.index(row, column) = -1;
      }
    }
  }
}

/// The median of 5 x 5 pixels, those at the border repeated beyond it.
Image<float> medianOf(const Image<float>& depth) {
  constexpr int reach = 2, edge = 2 * reach + 1;
  Image<float> median(depth.width, depth.height);
  std::array<float, edge * edge> window;
  for (int row = 0; row < depth.height; ++row) {
    for (int column = 0; column < depth.width; ++column) {
      for (int k = 0; k < edge * edge; ++k) {
        window[std::size_t(k)] = depth(std::clamp(row + k / edge - reach, 0, depth.height - 1),
                                       std::clamp(column + k % edge - reach, 0, depth.width - 1));
      }
      const auto middle = window.begin() + edge * edge / 2;
      std::nth_element(window.begin(), middle, window.end());
      median(row, column) = *middle;
    }
  }
  return median;
}

/// Cosine of the angle between the line of sight and the surface's normal, from the depths around a pixel.
float inclination(const Image<float>& depth, const ViewCamera& camera, int row, int column) {
  const auto at = [&](int r, int c) -> Eigen::Vector3d { return depth(r, c) * camera.ray(c, r); };
  const int reach = 3;
  const int left = std::max(column - reach, 0), right = std::min(column + reach, depth.width - 1);
  const int top = std::max(row - reach, 0), bottom = std::min(row + reach, depth.height - 1);
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
Rgb shade(float share_of_depth, float cosine) {
  const float light = 0.25f + 0.75f * std::min(cosine, 1.0f);
  const Eigen::Vector3f near(235, 215, 190), far(120, 150, 200);
  const Eigen::Vector3f color = light * ((1 - share_of_depth) * near + share_of_depth * far);
  const auto byte = [&](int channel) { return std::uint8_t(std::lround(color[channel])); };
  return {byte(0), byte(1), byte(2)};
}

}  // namespace

ColorImage renderPoints(const Cloud& cloud, const ViewCamera& camera, PictureSize size) {
  Buffer buffer = splat(project(cloud, camera, size), size);
  for (int pass = 0; pass < 3; ++pass) closeGaps(buffer);  // three close a crossing of lines one pixel wide

  std::vector<float> depths;
  for (const float depth : buffer.depth.pixels) {
    if (depth < no_depth) depths.push_back(depth);
  }
  std::sort(depths.begin(), depths.end());
  const float near = depths.empty() ? 0 : depths[depths.size() / 50],
              far = depths.empty() ? 1 : depths[depths.size() - 1 - depths.size() / 50];
  const Image<float> smooth = cloud.hasColor() ? Image<float>() : medianOf(buffer.depth);

  ColorImage image(size.width, size.height, background);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const int index = buffer.index(row, column);
      if (index < 0) continue;
      if (cloud.hasColor()) {
        image(row, column) = cloud.colors[std::size_t(index)];
      } else {
        const float share = std::clamp((buffer.depth(row, column) - near) / std::max(far - near, 1e-6f), 0.0f, 1.0f);
        const bool known = smooth(row, column) < no_depth;
        image(row, column) = shade(share, known ? inclination(smooth, camera, row, column) : 0.5f);
      }
    }
  }
  return image;
}

}  // namespace sks
