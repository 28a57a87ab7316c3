// SPDX-License-Identifier: BSD-3-Clause
#include "core/tracking/object_crop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace sks {
namespace {

constexpr std::uint32_t coarse = 8;  // rows and columns between the points that tell where in the image the box is
constexpr int corners = 8;

/// The rectangle of directions in which a box appears.
class DirectionWindow {
public:
  DirectionWindow(const Eigen::Vector3f& sensor, const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& half)
      : sensor_(sensor) {
    const Eigen::Vector3f ahead = T_cloud_box.translation().cast<float>() - sensor;
    distance_ = ahead.norm();
    all_ = distance_ <= float(half.norm());  // the sensor is in the box, or nearly
    if (all_) return;
    axes_ = Eigen::Quaternionf::FromTwoVectors(ahead, Eigen::Vector3f::UnitZ()).toRotationMatrix();
    for (int i = 0; i < corners; ++i) {
      const Eigen::Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      const Eigen::Vector3f corner = axes_ * ((T_cloud_box * sign.cwiseProduct(half)).cast<float>() - sensor);
      if (corner.z() <= 0) {
        all_ = true;
        return;
      }
      seen_.extend(Eigen::Vector2f(corner.head<2>() / corner.z()));
    }
  }

  /// False for NaN.
  bool contains(const Eigen::Vector3f& point) const {
    if (all_) return point.allFinite();
    const Eigen::Vector3f p = axes_ * (point - sensor_);
    if (!(p.z() > 0)) return false;
    return p.x() >= seen_.min().x() * p.z() && p.x() <= seen_.max().x() * p.z() && p.y() >= seen_.min().y() * p.z() &&
           p.y() <= seen_.max().y() * p.z();
  }

  /// Of the window's larger edge at the box [m]; 0: unknown.
  float width() const { return all_ ? 0 : distance_ * seen_.sizes().maxCoeff(); }

private:
  Eigen::Vector3f sensor_;
  Eigen::Matrix3f axes_ = Eigen::Matrix3f::Identity();
  Eigen::AlignedBox2f seen_;
  float distance_ = 0;
  bool all_ = false;
};

/// Columns and rows [first, last].
struct PixelWindow {
  std::uint32_t left = std::numeric_limits<std::uint32_t>::max(), top = left, right = 0, bottom = 0;

  void extend(std::uint32_t column, std::uint32_t row) {
    left = std::min(left, column), right = std::max(right, column);
    top = std::min(top, row), bottom = std::max(bottom, row);
  }
  bool empty() const { return right < left; }
  void widen(std::uint32_t by, const Cloud& cloud) {
    left -= std::min(left, by), top -= std::min(top, by);
    right = std::min(right + by, cloud.width - 1), bottom = std::min(bottom + by, cloud.height - 1);
  }
};

PixelWindow pixelsOf(const DirectionWindow& window, const Cloud& cloud) {
  PixelWindow pixels;
  for (std::uint32_t row = coarse / 2; row < cloud.height; row += coarse) {
    for (std::uint32_t column = coarse / 2; column < cloud.width; column += coarse) {
      if (window.contains(cloud.points[std::size_t(row) * cloud.width + column])) pixels.extend(column, row);
    }
  }
  if (!pixels.empty()) pixels.widen(coarse, cloud);
  return pixels;
}

void take(const Cloud& cloud, std::size_t point, Cloud& part) {
  part.points.push_back(cloud.points[point]);
  if (cloud.hasColor()) part.colors.push_back(cloud.colors[point]);
}

}  // namespace

ObjectCrop cropAround(const Cloud& cloud, const Eigen::Isometry3d& T_cloud_box, const Eigen::Vector3d& half_size,
                      double spacing) {
  ObjectCrop crop;
  Cloud& part = crop.cloud;
  part.sensor_origin = cloud.sensor_origin;
  const DirectionWindow window(cloud.sensor_origin, T_cloud_box, half_size);
  if (!cloud.organized()) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (window.contains(cloud.points[i])) take(cloud, i, part);
    }
    part.width = std::uint32_t(part.size());
    return crop;
  }
  const PixelWindow pixels = pixelsOf(window, cloud);
  if (pixels.empty()) return crop;
  const std::uint32_t columns = pixels.right - pixels.left + 1, rows = pixels.bottom - pixels.top + 1;
  const double apart = double(window.width()) / std::max(columns, rows);
  if (apart > 0) crop.stride = int(std::clamp(spacing / apart, 1.0, double(coarse)));
  const auto stride = std::uint32_t(crop.stride);
  for (std::uint32_t row = pixels.top; row <= pixels.bottom; row += stride) {
    for (std::uint32_t column = pixels.left; column <= pixels.right; column += stride) {
      take(cloud, std::size_t(row) * cloud.width + column, part);
    }
  }
  part.width = (columns + stride - 1) / stride;
  part.height = (rows + stride - 1) / stride;
  return crop;
}

}  // namespace sks
