// SPDX-License-Identifier: BSD-3-Clause
#include "core/registration/view_silhouette.hpp"

#include <algorithm>
#include <cstddef>

namespace sks {
namespace {

constexpr int widest = 40;  // [cells] distances beyond are not told apart

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

}  // namespace sks
