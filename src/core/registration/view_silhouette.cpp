// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_silhouette.hpp"

#include <algorithm>
#include <cstddef>

namespace sks {
namespace {

constexpr int widest = 40;  // [cells] distances beyond are not told apart
constexpr float flat_slope = 0.1f;

/// Distances along rows, columns and diagonals to the nearest zero, in two passes.
void spreadDistances(std::vector<std::uint8_t>& distances, int width, int height) {
  const auto relax = [&](int row, int column, int from_row, int from_column) {
    if (from_row < 0 || from_column < 0 || from_row >= height || from_column >= width) return;
    std::uint8_t& own = distances[std::size_t(row) * std::size_t(width) + std::size_t(column)];
    const int other = distances[std::size_t(from_row) * std::size_t(width) + std::size_t(from_column)];
    own = std::uint8_t(std::min(int(own), std::min(other + 1, widest + 1)));
  };
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) {
      relax(r, c, r, c - 1);
      for (int d = -1; d <= 1; ++d) relax(r, c, r - 1, c + d);
    }
  }
  for (int r = height - 1; r >= 0; --r) {
    for (int c = width - 1; c >= 0; --c) {
      relax(r, c, r, c + 1);
      for (int d = -1; d <= 1; ++d) relax(r, c, r + 1, c + d);
    }
  }
}

}  // namespace

ViewSilhouette::ViewSilhouette(const RangeImage& image) : projection_(image.projection()) {
  if (image.cells().empty()) return;
  width_ = projection_.width + 2 * widest;
  height_ = projection_.height + 2 * widest;
  distances_.assign(std::size_t(width_) * std::size_t(height_), std::uint8_t(widest + 1));
  for (int r = 0; r < projection_.height; ++r) {
    for (int c = 0; c < projection_.width; ++c) {
      const bool measured =
          image.cells()[std::size_t(r) * std::size_t(projection_.width) + std::size_t(c)].farthest >= 0;
      if (measured) distances_[std::size_t(r + widest) * std::size_t(width_) + std::size_t(c + widest)] = 0;
    }
  }
  spreadDistances(distances_, width_, height_);
}

bool ViewSilhouette::isOutside(const Eigen::Vector3f& position, float margin) const {
  const Eigen::Vector3f p = projection_.axes * (position - projection_.origin);
  const float range = p.norm();
  if (distances_.empty() || p.z() <= RangeImage::rim * range) return true;
  const float column = (p.x() / p.z() - projection_.u0) / projection_.cell + float(widest);
  const float row = (p.y() / p.z() - projection_.v0) / projection_.cell + float(widest);
  if (!(column >= 0 && row >= 0 && column < float(width_) && row < float(height_))) return true;
  const float limit = std::min(float(widest), margin / (p.z() * projection_.cell));
  return float(distances_[std::size_t(row) * std::size_t(width_) + std::size_t(column)]) > limit + 0.5f;
}

/// Between the middles of cells [cells].
float ViewSilhouette::distanceAt(float column, float row) const {
  const float c = std::clamp(column - 0.5f, 0.0f, float(width_ - 1)),
              r = std::clamp(row - 0.5f, 0.0f, float(height_ - 1));
  const int left = std::min(int(c), width_ - 2), upper = std::min(int(r), height_ - 2);
  const auto at = [&](int x, int y) {
    return float(distances_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]);
  };
  const float u = c - float(left), v = r - float(upper);
  return (1 - v) * ((1 - u) * at(left, upper) + u * at(left + 1, upper)) +
         v * ((1 - u) * at(left, upper + 1) + u * at(left + 1, upper + 1));
}

Eigen::Vector3f ViewSilhouette::wayInside(const Eigen::Vector3f& position) const {
  const Eigen::Vector3f p = projection_.axes * (position - projection_.origin);
  if (distances_.empty() || p.z() <= RangeImage::rim * p.norm()) return Eigen::Vector3f::Zero();
  const float column = (p.x() / p.z() - projection_.u0) / projection_.cell + float(widest);
  const float row = (p.y() / p.z() - projection_.v0) / projection_.cell + float(widest);
  const float distance = distanceAt(column, row);
  const Eigen::Vector3f slope(distanceAt(column + 1, row) - distanceAt(column - 1, row),
                              distanceAt(column, row + 1) - distanceAt(column, row - 1), 0);
  if (distance <= 0 || slope.norm() < flat_slope) return Eigen::Vector3f::Zero();
  return -distance * projection_.cell * p.z() * (projection_.axes.transpose() * slope.normalized());
}

}  // namespace sks
